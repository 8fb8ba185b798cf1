// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// A set of particles of a scene, as a list and as a predicate: `set(i)` tells whether particle i belongs to it, and
/// `set.indices()` are those that do, in order. Wherever the library takes a predicate of particles or a list of them,
/// a set serves, and `~set` where the opposite is asked for:
///
///     const hmps::ParticleSet clamped(X.size(), [&](std::size_t i) { return X(i, 0) < 0; });
///     hmps::hold(v, clamped);
///     force.restrict_to(~clamped);
class ParticleSet {
 public:
  /// The particles of `size` for which `belongs(i)` holds.
  template <class Belongs>
  requires std::predicate<Belongs&, std::size_t> ParticleSet(std::size_t size, Belongs&& belongs) : member_(size) {
    for (std::size_t i = 0; i < size; ++i) member_[i] = belongs(i) ? 1 : 0;
    list();
  }
  /// The particles of `size` that are in `indices`, in any order. Throws `InputError` for an index beyond `size` and
  /// for one that is given twice.
  ParticleSet(std::size_t size, const std::vector<Index>& indices) : member_(size) {
    for (const Index i : indices) {
      require(i < size, "hmps: a set of particles names particle ", i, " but there are only ", size,
              "; number them from 0");
      require(member_[i] == 0, "hmps: a set of particles names particle ", i, " twice; name each once");
      member_[i] = 1;
    }
    list();
  }

  /// Whether particle `i` belongs to the set; false beyond the last particle of the scene.
  [[nodiscard]] bool operator()(std::size_t i) const { return i < member_.size() && member_[i] != 0; }
  /// The particles of the set, in order.
  [[nodiscard]] const std::vector<Index>& indices() const { return indices_; }
  [[nodiscard]] auto begin() const { return indices_.begin(); }
  [[nodiscard]] auto end() const { return indices_.end(); }
  /// How many particles belong to the set.
  [[nodiscard]] std::size_t size() const { return indices_.size(); }
  /// How many particles the scene has.
  [[nodiscard]] std::size_t scene_size() const { return member_.size(); }

  /// All particles of the scene that do not belong to the set.
  [[nodiscard]] ParticleSet operator~() const {
    return {scene_size(), [this](std::size_t i) { return !(*this)(i); }};
  }
  /// Those of either set, and those of both. Throws `InputError` for sets of different scenes.
  [[nodiscard]] friend ParticleSet operator|(const ParticleSet& a, const ParticleSet& b) {
    require_same_scene(a, b);
    return {a.scene_size(), [&](std::size_t i) { return a(i) || b(i); }};
  }
  [[nodiscard]] friend ParticleSet operator&(const ParticleSet& a, const ParticleSet& b) {
    require_same_scene(a, b);
    return {a.scene_size(), [&](std::size_t i) { return a(i) && b(i); }};
  }
  [[nodiscard]] friend bool operator==(const ParticleSet& a, const ParticleSet& b) { return a.member_ == b.member_; }

 private:
  static void require_same_scene(const ParticleSet& a, const ParticleSet& b) {
    require(a.scene_size() == b.scene_size(), "hmps: two sets of particles are of ", a.scene_size(), " and of ",
            b.scene_size(), " particles; make both of the same scene");
  }
  void list() {
    for (std::size_t i = 0; i < member_.size(); ++i)
      if (member_[i] != 0) indices_.push_back(static_cast<Index>(i));
  }

  std::vector<char> member_;
  std::vector<Index> indices_;
};

}  // namespace hmps::inline HMPS_ABI
