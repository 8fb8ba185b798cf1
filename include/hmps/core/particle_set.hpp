// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// A set of particles, usable as a list and as a predicate: `set(i)` says whether particle i belongs to it, and
/// `set.indices()` lists its particles in order. It can be passed wherever the library takes a predicate of particles,
/// and `indices()` wherever it takes a list; `~set` is the complement:
///
///     const hmps::ParticleSet clamped(X.size(), [&](std::size_t i) { return X(i, 0) < 0; });
///     hmps::hold(v, clamped);
///     force.restrict_to(~clamped);
class ParticleSet {
 public:
  /// The particles in `[0, size)` for which `belongs(i)` holds.
  template <class Belongs>
  requires std::predicate<Belongs&, std::size_t> ParticleSet(std::size_t size, Belongs&& belongs) : member_(size) {
    for (std::size_t i = 0; i < size; ++i) member_[i] = belongs(i) ? 1 : 0;
    list();
  }
  /// The particles `indices`, in any order, of a scene of `size` particles. Throws `InputError` for an index that is
  /// out of range or repeated.
  ParticleSet(std::size_t size, const std::vector<Index>& indices) : member_(size) {
    for (const Index i : indices) {
      detail::require(i < size, "hmps: a set of particles names particle ", i, " but there are only ", size,
                      "; indices start at 0");
      detail::require(member_[i] == 0, "hmps: a set of particles names particle ", i, " twice; name each once");
      member_[i] = 1;
    }
    list();
  }

  /// Whether particle `i` belongs to the set; false if it is out of range.
  [[nodiscard]] bool operator()(std::size_t i) const { return i < member_.size() && member_[i] != 0; }
  /// The same, as standard sets have it.
  [[nodiscard]] bool contains(std::size_t i) const { return (*this)(i); }
  /// The particles of the set, in order.
  [[nodiscard]] const std::vector<Index>& indices() const { return indices_; }
  [[nodiscard]] auto begin() const { return indices_.begin(); }
  [[nodiscard]] auto end() const { return indices_.end(); }
  /// The number of particles in the set.
  [[nodiscard]] std::size_t size() const { return indices_.size(); }
  [[nodiscard]] bool empty() const { return indices_.empty(); }
  /// The number of all particles.
  [[nodiscard]] std::size_t scene_size() const { return member_.size(); }

  /// The complement of the set.
  [[nodiscard]] ParticleSet operator~() const {
    return {scene_size(), [this](std::size_t i) { return !(*this)(i); }};
  }
  /// Union and intersection. Throws `InputError` for sets of different scenes.
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
    detail::require(a.scene_size() == b.scene_size(), "hmps: two sets of particles are for scenes of ", a.scene_size(),
                    " and ", b.scene_size(), " particles; make both for the same scene");
  }
  void list() {
    for (std::size_t i = 0; i < member_.size(); ++i)
      if (member_[i] != 0) indices_.push_back(static_cast<Index>(i));
  }

  std::vector<char> member_;
  std::vector<Index> indices_;
};

namespace detail {

/// The set of particles behind `predicate`: itself, or the one that it holds as a `std::function` (detected only with
/// RTTI). Null if there is none.
template <class Predicate>
[[nodiscard]] const ParticleSet* set_in([[maybe_unused]] const Predicate& predicate) {
  if constexpr (std::is_same_v<Predicate, ParticleSet>) return &predicate;
#ifdef __cpp_rtti
  if constexpr (requires { predicate.template target<ParticleSet>(); }) return predicate.template target<ParticleSet>();
#endif
  return nullptr;
}

/// Throws `InputError` if `predicate` is a set of particles for a scene that does not have `size` particles. `what`
/// says in the message which particles they are.
template <class Predicate>
void require_scene(const Predicate& predicate, std::size_t size, const char* what) {
  const ParticleSet* const set = set_in(predicate);
  require(set == nullptr || set->scene_size() == size, "hmps: the set of particles ", what, " is for a scene of ",
          set == nullptr ? 0 : set->scene_size(), " particles, but there are ", size, "; make it for all of them");
}

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
