// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "hmps/contact/master_surface.hpp"
#include "hmps/contact/metaball.hpp"
#include "hmps/contact/normal_density.hpp"
#include "hmps/contact/penetration.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"
#include "hmps/lanes/detail/quad.hpp"

/// The contact of one slave with one wall, sections 2.7 to 2.9 of the paper: the physics, independent of how slaves and
/// masters are found and where results go.
namespace hmps::inline HMPS_ABI::detail {

/// The data of a master that determine the distance of its wall; one cache line in float.
template <class S, int D>
struct alignas(64) Master {
  Quad<S> x, A[std::size_t{D}];  // position in m, and the columns of A = F^-T F^-1
};
/// Further data of a master, for walls in contact.
template <class S, int D>
struct alignas(64) MovingMaster {
  Quad<S> v, B[std::size_t{D}];  // velocity in m/s, and the columns of B = F^-1
};

/// The masters of a wall: those numbered `number[0]` to `number[size - 1]`.
template <class S, int D>
struct Wall {
  const Master<S, D>* masters;
  const MovingMaster<S, D>* moving;
  const Index* number;
  std::size_t size;
};

/// Result of `slave_contact`.
template <class S, int D>
struct SlaveContact {
  S penetration = 0;  ///< p in m, \paper{38}; if zero, there is no contact, and only `lost` and `depth` are valid.
  Vector<S, D> slip;  ///< v_im in m/s, \paper{31}.
  S over_density;     ///< 1 / C_im
  /// The slave is so deep that the outward direction is undefined or that there is no normal.
  bool lost = false;
  S depth = 0;               ///< In m: p or, without a normal, the depth in an undeformed wall.
  bool inside;               ///< Its centre is less than 0.6 spacings above the outermost layer of the wall.
  Vector<float, D> outward;  ///< The normal before the rotation of the masters.
};

/// Evaluates a slave of radius r_0 (m) at `place` (m) against `wall`. Writes the normal n_m to `normal` if the wall is
/// within reach, and the metaballs c_ij of all masters to `c`. `gradient()` returns F_i and `velocity()` v_i in m/s;
/// they are called only when needed, which for most slaves is never. `compression` is an upper bound of the inverse of
/// the stretch.
template <class S, int D, Metaball Kernel, class Gradient, class Velocity>
[[nodiscard]] HMPS_INLINE SlaveContact<S, D> slave_contact(const NormalDensity<S, D, Kernel>& Z, const Quad<S>& place,
                                                           const Wall<S, D>& wall, S slave_radius, S compression,
                                                           Gradient&& gradient, Velocity&& velocity,
                                                           Vector<S, D>& normal, S* c) {
  const S l0 = Z.spacing(), radius = static_cast<S>(Kernel::radius) * l0;
  const S over_radius_squared = S(1) / (radius * radius);
  SlaveContact<S, D> contact;

  MasterSurface<S, D, Kernel> surface;
  for (std::size_t k = 0; k < wall.size; ++k) {
    const Master<S, D>& master = wall.masters[wall.number[k]];
    Quad<S> towards = master.x;
    towards -= place;
    c[k] = surface.reach(master.A, towards, over_radius_squared);  // (26), (28), (30)
  }
  const auto centres = Z.inverse(surface.density());  // R_im, (29)
  if (!centres.reached) return contact;
  if (!surface.normal(radius, normal)) {
    contact.lost = true;
    contact.depth = l0 - centres.value;
    return contact;
  }
  const S support = slave_support<S, D>(gradient(), normal, slave_radius);  // r_i, (37)
  // The stretch is at least 1 / compression: most slaves nearby need no second pass.
  if (!(surface_distance(S(1), centres.value, l0) < support * compression)) return contact;

  for (std::size_t k = 0; k < wall.size; ++k)
    if (c[k] > S(0)) {
      const MovingMaster<S, D>& master = wall.moving[wall.number[k]];
      surface.mean(c[k], master.B, master.v);  // (31), (33)
    }
  const S stretch = surface.stretch(normal);                                       // (32)
  const S p = penetration(support, surface_distance(stretch, centres.value, l0));  // (34) to (36), (38)
  if (!(p > S(0))) return contact;

  contact.penetration = contact.depth = p;
  contact.slip = surface.relative_velocity(velocity());  // (31)
  contact.over_density = S(1) / surface.density();
  // Where the sum falls too little across a wall, the outward direction is undefined. In a wall of one layer this
  // happens within 0.6 spacings; further out the sum falls little as well, but there the slave is not inside.
  contact.inside = centres.value < S(0.6) * l0;
  contact.lost =
      centres.deep || (contact.inside && surface.gradient(over_radius_squared).norm() * stretch < Z.least_slope());
  contact.outward = surface.unturned(normal).template cast<float>().normalized();
  return contact;
}

}  // namespace hmps::inline HMPS_ABI::detail
