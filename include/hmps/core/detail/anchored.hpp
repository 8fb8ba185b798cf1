// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "hmps/core/abi.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Base class of objects that others refer to and that may be moved, such as bodies in a growing `std::vector`. An
/// `Anchor` knows the current address of its object, and whether it still exists.
class Anchored {
  using Place = std::shared_ptr<const Anchored*>;

 public:
  /// A reference to an `Anchored` that follows its moves.
  class Anchor {
   public:
    explicit Anchor(const Anchored& object) : place_(object.place_) {}
    /// The current address of the object; null if it was destroyed or assigned to.
    [[nodiscard]] const Anchored* object() const { return place_ ? *place_ : nullptr; }

   private:
    Place place_;
  };

 protected:
  Anchored() : place_(std::make_shared<const Anchored*>(this)) {}
  Anchored(const Anchored&) : Anchored() {}
  Anchored(Anchored&& other) noexcept : place_(std::move(other.place_)) { settle(); }
  Anchored& operator=(const Anchored& other) {
    if (this == &other) return *this;
    leave();
    place_ = std::make_shared<const Anchored*>(this);
    return *this;
  }
  Anchored& operator=(Anchored&& other) noexcept {
    if (this == &other) return *this;
    leave();
    place_ = std::move(other.place_);
    settle();
    return *this;
  }
  ~Anchored() { leave(); }

 private:
  void settle() {
    if (place_) *place_ = this;
  }
  void leave() {
    if (place_) *place_ = nullptr;
  }
  Place place_;  ///< Null in a moved-from object.
};

}  // namespace hmps::inline HMPS_ABI::detail
