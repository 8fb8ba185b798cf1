// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/anchored.hpp"
#include "hmps/core/detail/disjoint_sets.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/lanes/detail/pieces.hpp"
#include "hmps/lanes/detail/slots.hpp"
#include "hmps/lanes/lanes.hpp"

namespace hmps::inline HMPS_ABI {

/// The particles of a body in the order in which the sweeps visit them. A sweep works on one block of `width` particles
/// at a time, one particle per lane. The position of a particle in this order is its slot; unused slots of the last
/// block are empty. Base class of all bonds: holds the reference configuration (\paper{12}).
template <class K, int D>
class Blocks : public detail::Anchored {
 public:
  using Scalar = K;
  static constexpr int dimension = D;
  static constexpr std::size_t width = static_cast<std::size_t>(Lanes<K>::width);
  static constexpr Index none = detail::no_index;

  /// Number of particles.
  [[nodiscard]] std::size_t size() const { return slot_of_.size(); }
  [[nodiscard]] std::size_t block_count() const { return particle_of_.size() / width; }
  [[nodiscard]] std::size_t slot_count() const { return particle_of_.size(); }
  /// The particle in `slot`, or `none`.
  [[nodiscard]] Index particle(std::size_t slot) const { return particle_of_[slot]; }
  /// The slot of `particle`. Throws `InputError`, like all functions here and in bonds that take the number of a
  /// particle, for one that does not exist.
  [[nodiscard]] std::size_t slot(std::size_t particle) const {
    detail::require_index(particle, slot_of_.size(), "particle", "these bonds have");
    return slot_of_[particle];
  }

  /// Component `c` of the reference position of `particle`, in m.
  [[nodiscard]] double reference(std::size_t particle, int c) const {
    return reference_(static_cast<std::size_t>(c), slot(particle));
  }
  /// The reference position of `particle`, in m.
  [[nodiscard]] Vector<double, D> reference(std::size_t particle) const {
    Vector<double, D> x;
    for (int c = 0; c < D; ++c) x[c] = reference(particle, c);
    return x;
  }
  /// A^-1 of `particle`, in 1/m2 (\paper{12}).
  [[nodiscard]] Matrix<K, D> shape_inverse(std::size_t particle) const {
    Matrix<K, D> inverse;
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) inverse(r, c) = shape_(symmetric(r, c), shape_slot(slot(particle)));
    return inverse;
  }
  /// tr A = sum |r0|^2 w of `particle`, in m2, the sum in \paper{20}.
  [[nodiscard]] K shape_trace(std::size_t particle) const {
    return K(1) / shape_(inverse_trace, shape_slot(slot(particle)));
  }

  /// Before displacements are rounded to `K`, the sweeps subtract the displacement of one particle in the middle of
  /// their order, `particle(size() / 2)`; for a piece without bonds to that particle which has moved further than
  /// `far_apart` from it, that of one of its own particles. After this call they subtract `common` (m) from all
  /// instead, so that the parts of a body, each on its own machine, round as the whole does as long as its pieces stay
  /// together. Throws `InputError` if `common` is not finite.
  void subtract_displacement(const Vector<double, D>& common) {
    detail::require(detail::all_finite(common), "hmps: the displacement to subtract is (", common,
                    ") m; give finite numbers");
    common_ = common;
  }
  /// The argument of `subtract_displacement`, if it was called.
  [[nodiscard]] const std::optional<Vector<double, D>>& subtracted_displacement() const { return common_; }
  /// The pieces that no bonds join.
  [[nodiscard]] const detail::Pieces& pieces() const { return pieces_; }
  /// The displacement in m, about 100 spacings in float, whose rounding to `K` is 1.25e-5 spacings.
  [[nodiscard]] double far_apart() const { return far_apart_; }

  /// Particle number density n^0 and lambda (m2) of a particle inside the body (\paper{21}). `LatticeBonds` takes those
  /// of the full lattice, `BondList` those of the particle with the largest sum of w r0^2.
  [[nodiscard]] double standard_density() const { return standard_density_; }
  [[nodiscard]] double standard_lambda() const { return standard_lambda_; }

  /// Memory of the reference configuration in bytes, without the bonds.
  [[nodiscard]] std::size_t bytes() const {
    return (particle_of_.size() + slot_of_.size() + shape_block_.size()) * sizeof(Index) + consecutive_.size() +
           reference_.bytes() + shape_.bytes() + pieces_.bytes();
  }

  // The sweeps read the following, one block of lanes at a time.

  [[nodiscard]] HMPS_INLINE Matrix<Lanes<K>, D> shape_inverse_lanes(std::size_t block) const {
    Matrix<Lanes<K>, D> inverse;
    for (int c = 0; c < D; ++c)
      for (int r = 0; r <= c; ++r) {
        inverse(r, c) = shape_lanes(symmetric(r, c), block);
        inverse(c, r) = inverse(r, c);
      }
    return inverse;
  }
  [[nodiscard]] HMPS_INLINE Lanes<K> inverse_trace_lanes(std::size_t block) const {
    return shape_lanes(inverse_trace, block);
  }
  [[nodiscard]] HMPS_INLINE Lanes<K> asymmetry_lanes(std::size_t block, int c) const {
    return shape_lanes(asymmetry + static_cast<std::size_t>(c), block);
  }
  /// Whether the particles of `block` are consecutive in the user's arrays.
  [[nodiscard]] HMPS_INLINE bool consecutive(std::size_t block) const { return consecutive_[block] != 0; }
  /// Where the sweeps read last for `block`, as a hint from where to prefetch; here, if nothing better is known, in the
  /// block itself.
  [[nodiscard]] HMPS_INLINE std::size_t last_slot(std::size_t block) const { return block * width; }
  [[nodiscard]] HMPS_INLINE const double* reference_slots(int c) const {
    return &reference_(static_cast<std::size_t>(c), 0);
  }

 protected:
  /// Assigns the slots in the order of `order`, a permutation of all particles.
  template <class T>
  Blocks(const VectorView<T, D>& reference, const std::vector<Index>& order)
      : particle_of_((order.size() + width - 1) / width * width, none),
        slot_of_(order.size()),
        reference_(particle_of_.size()) {
    detail::require(order.size() < std::size_t{1} << 31, "hmps: ", order.size(),
                    " particles are more than the 2^31 that bonds can number; divide the body into parts");
    std::copy(order.begin(), order.end(), particle_of_.begin());
    for (std::size_t s = 0; s < order.size(); ++s) slot_of_[order[s]] = static_cast<Index>(s);
    for (int c = 0; c < D; ++c)
      for (std::size_t s = 0; s < order.size(); ++s)
        reference_(static_cast<std::size_t>(c), s) = static_cast<double>(reference(order[s], c));
    consecutive_.resize(block_count());
    for (std::size_t b = 0; b < block_count(); ++b) {
      bool run = true;
      for (std::size_t l = 1; l < width; ++l)
        run = run && particle_of_[b * width + l] != none && particle_of_[b * width + l] == particle_of_[b * width] + l;
      consecutive_[b] = run ? 1 : 0;
    }
    shape_ = Shapes(slot_count());
    shape_block_.resize(block_count());
    std::iota(shape_block_.begin(), shape_block_.end(), Index{0});
  }

  /// Stores the neighbourhood sums of `particle`: A^-1, sum w r0 and tr A; zero without bonds.
  void set_shape(std::size_t particle, const Matrix<double, D>& shape_inverse, const Vector<double, D>& asymmetric_sum,
                 double trace) {
    const std::size_t slot = slot_of_[particle];
    for (int c = 0; c < D; ++c) {
      shape_(asymmetry + static_cast<std::size_t>(c), slot) = static_cast<K>(asymmetric_sum[c]);
      for (int r = 0; r <= c; ++r) shape_(symmetric(r, c), slot) = static_cast<K>(shape_inverse(r, c));
    }
    shape_(inverse_trace, slot) = trace > 0 ? static_cast<K>(1.0 / trace) : K(0);
  }
  /// Call this once after the last `set_shape`. Blocks whose particles all have the same neighbourhood, such as those
  /// inside a lattice or along its faces, then share one copy.
  void share_shapes() {
    std::map<std::array<K, shape_components>, Index> shared;
    std::vector<std::size_t> kept;  // blocks
    for (std::size_t b = 0; b < block_count(); ++b) {
      std::array<K, shape_components> first;
      bool uniform = true;
      for (std::size_t c = 0; c < shape_components; ++c) {
        const K* lanes = &shape_(c, b * width);
        first[c] = lanes[0];
        uniform = uniform && std::all_of(lanes, lanes + width, [&](K value) { return value == lanes[0]; });
      }
      const auto next = static_cast<Index>(kept.size());
      shape_block_[b] = uniform ? shared.emplace(first, next).first->second : next;
      if (shape_block_[b] == next) kept.push_back(b);
    }
    Shapes shapes(kept.size() * width);
    for (std::size_t c = 0; c < shape_components; ++c)
      for (std::size_t k = 0; k < kept.size(); ++k) shapes.store(c, k * width, shape_.lanes(c, kept[k] * width));
    shape_ = std::move(shapes);
  }
  void set_standard(double density, double lambda) {
    standard_density_ = density;
    standard_lambda_ = lambda;
  }
  /// Stores the pieces of a body with the particle `spacing` (m) from all particles that bonds join.
  void set_pieces(detail::DisjointSets& joined, double spacing) {
    pieces_ = detail::Pieces(joined, particle_of_);
    far_apart_ = 1.25e-5 * spacing / static_cast<double>(std::numeric_limits<K>::epsilon());
  }

 private:
  // Components of shape_: those of A^-1 on and above the diagonal, then these.
  static constexpr std::size_t asymmetry = D * (D + 1) / 2, inverse_trace = asymmetry + D,
                               shape_components = inverse_trace + 1;
  using Shapes = detail::SlotArrays<K, shape_components>;

  [[nodiscard]] std::size_t shape_slot(std::size_t slot) const {
    return shape_block_[slot / width] * width + slot % width;
  }
  [[nodiscard]] HMPS_INLINE Lanes<K> shape_lanes(std::size_t component, std::size_t block) const {
    return shape_.lanes(component, shape_block_[block] * width);
  }
  [[nodiscard]] static constexpr std::size_t symmetric(int r, int c) {
    return static_cast<std::size_t>(r < c ? r + c * (c + 1) / 2 : c + r * (r + 1) / 2);
  }

  std::vector<Index> particle_of_;
  std::vector<Index> slot_of_;
  std::vector<std::uint8_t> consecutive_;
  detail::SlotArrays<double, std::size_t{D}> reference_;
  Shapes shape_;
  std::vector<Index> shape_block_;  ///< Index into shape_ of the lanes of each block.
  std::optional<Vector<double, D>> common_;
  detail::Pieces pieces_;
  double far_apart_ = 0;
  double standard_density_ = 0;
  double standard_lambda_ = 0;
};

}  // namespace hmps::inline HMPS_ABI
