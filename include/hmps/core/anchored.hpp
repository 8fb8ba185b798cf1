// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "hmps/core/abi.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Base of an object that others refer to and that may be moved meanwhile, as bodies in a `std::vector` are when it
/// grows: an `Anchor` of it knows where it is now, and when it is no more.
class Anchored {
  using Place = std::shared_ptr<const Anchored*>;

 public:
  /// Refers to an `Anchored` wherever it goes.
  class Anchor {
   public:
    explicit Anchor(const Anchored& object) : place_(object.place_) {}
    /// Where the object is; null if it was destroyed or assigned to.
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
  Place place_;  ///< Null in an object that was moved from.
};

}  // namespace hmps::inline HMPS_ABI::detail
