// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"
#include "hmps/lanes/detail/quad.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The motion of a wall at a slave, relative to the slave: the rigid motion that best fits the wall's masters, by
/// weighted least squares. The motion that slave and masters share must be subtracted first: where the masters do not
/// determine a rotation, its rounding errors would appear as one. The mean motion of the masters, \paper{31}, is that
/// of their centre, half a spacing or more behind the surface, and differs from the motion at the slave if the wall
/// rotates.
template <class S, int D>
class WallMotion {
 public:
  using Point = Vector<S, D>;
  using Tensor = Matrix<S, D>;

  /// `spacing` in m.
  explicit WallMotion(S spacing) : spacing_(spacing) {}
  /// Adds a master of weight `w` (the weights sum to 1) at `r` from the slave, in spacings, that moves by `moved` (m)
  /// relative to the slave; both vectors are padded with zeros. `r` is the one at the middle of the motion, which makes
  /// rotations of any angle exact.
  HMPS_INLINE void add(S w, const Quad<S>& r, const Quad<S>& moved) {
    const Quad<S> weighted = r * w;
    middle_ += weighted;
    mean_ += moved * w;
    for (std::size_t c = 0; c < D; ++c) {
      squares_[c] += weighted * r[c];
      products_[c] += weighted * moved[c];
    }
  }
  /// Completes the sums; call it before the functions below.
  void finish() {
    const Point middle = first<D, S>(middle_), mean = first<D, S>(mean_);
    Tensor squares, products;  // sum w r (x) r and sum w r (x) u about the middle
    for (int c = 0; c < D; ++c) {
      squares.col(c) = first<D, S>(squares_[static_cast<std::size_t>(c)]) - middle[c] * middle;
      products.col(c) = first<D, S>(products_[static_cast<std::size_t>(c)]) - mean[c] * middle;
    }
    // Masters on a line, or a single one, do not determine all rotations: a regularisation slightly above rounding
    // keeps the inverse finite.
    const S size = squares.trace() + S(100) * std::numeric_limits<S>::epsilon();
    const Tensor moment = products.transpose() - products;
    if constexpr (D == 2) {
      spin_ = moment / size;
    } else {
      const Tensor inertia = Tensor::Identity() * size - squares;
      const Point angle = inverse<S, D>(inertia) * Point(moment(2, 1), moment(0, 2), moment(1, 0));
      spin_ = skew<S>(angle);
    }
  }

  /// The displacement of the wall at the slave, relative to it, in m: the mean of its masters plus the effect of its
  /// rotation.
  [[nodiscard]] Point moved() const { return first<D, S>(mean_) + by_turning(); }
  [[nodiscard]] Point by_turning() const { return -(spin_ * first<D, S>(middle_)); }
  /// `vector` rotated with the wall; its length is preserved.
  [[nodiscard]] Point turned(const Point& vector) const {
    const Point once = spin_ * vector / spacing_;
    return scaled(vector + once + S(0.5) / spacing_ * (spin_ * once), vector.norm());
  }
  /// The component of `vector` normal to the unit vector `n`, scaled to the length of `vector`.
  [[nodiscard]] static Point across(const Point& vector, const Point& n) {
    return scaled(vector - vector.dot(n) * n, vector.norm());
  }

 private:
  [[nodiscard]] static Point scaled(const Point& vector, S length) {
    const S own = vector.norm();
    return own > S(0) ? Point(vector * (length / own)) : vector;
  }

  S spacing_;
  Quad<S> middle_{}, mean_{}, squares_[std::size_t{D}] = {}, products_[std::size_t{D}] = {};
  Tensor spin_ = Tensor::Zero();  // W of u = W r, in m for r in spacings
};

/// The displacements of the particles of all organs since the previous call, whatever moved them.
template <class S, int D>
class ParticleMotion {
 public:
  /// Chooses the particles `awake` from all `particle`; both ascend.
  template <class Awake>
  void choose(const std::vector<Index>& particle, const std::vector<Awake>& awake) {
    number_.clear();
    std::size_t n = 0;
    for (std::size_t t = 0; t + 1 < awake.size(); ++t) {
      while (particle[n] != awake[t].particle) ++n;
      number_.push_back(static_cast<Index>(n));
    }
  }
  /// Stores the positions `x` (m) of this call and updates the displacements, which are zero in the first call of each
  /// particle.
  template <class X, class E>
  void update(const X& x, const std::vector<Index>& particle, const E& execute) {
    if (place_.size() != particle.size()) take_in(x, particle);
    moved_.resize(particle.size());
    guarded(execute)((particle.size() + chunk - 1) / chunk, [&](std::size_t q) {
      for (std::size_t n = q * chunk; n < std::min(particle.size(), (q + 1) * chunk); ++n) {
        const Vector<double, D> place = x[particle[n]].template cast<double>();
        set_quad<S>((place - place_[n]).template cast<S>().eval(), moved_[n]);
        place_[n] = place;
      }
    });
  }
  /// Makes the next call of `update` the first one.
  void forget() {
    particle_.clear();
    place_.clear();
  }
  /// The positions in m of all particles at the latest call; none before the first.
  [[nodiscard]] const std::vector<Vector<double, D>>& places() const { return place_; }
  /// The particles of these, in order.
  [[nodiscard]] const std::vector<Index>& particles() const { return particle_; }
  /// Takes `places` as the positions of `particles`, in order, at the latest call.
  void restore(std::vector<Index> particles, std::vector<Vector<double, D>> places) {
    particle_ = std::move(particles);
    place_ = std::move(places);
  }
  /// The displacement in m of an active particle.
  [[nodiscard]] const Quad<S>& moved(std::size_t awake) const { return moved_[number_[awake]]; }
  /// The vector in m from the active particle `from` to `to`.
  [[nodiscard]] Vector<S, D> between(std::size_t from, std::size_t to) const {
    return (place_[number_[to]] - place_[number_[from]]).template cast<S>();
  }

 private:
  static constexpr std::size_t chunk = 512;

  /// Adds particles of organs that are new, which have not moved yet. Both lists ascend, and none loses a particle.
  template <class X>
  HMPS_COLD void take_in(const X& x, const std::vector<Index>& particle) {
    std::vector<Vector<double, D>> place;
    std::size_t k = 0;
    for (const Index i : particle) {
      const bool known = k < particle_.size() && particle_[k] == i;
      place.push_back(known ? place_[k] : Vector<double, D>(x[i].template cast<double>()));
      k += known;
    }
    place_ = std::move(place);
    particle_ = particle;
  }

  std::vector<Index> particle_;           // all particles, in the latest call
  std::vector<Vector<double, D>> place_;  // of these
  std::vector<Quad<S>> moved_;
  std::vector<Index> number_;  // per awake particle, among all
};

}  // namespace hmps::inline HMPS_ABI::detail
