// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/view_types.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {
/// Whether two numbers of `view` share memory, of different particles or of different components, as when one array is
/// given for two components. `apart` is the stride without its sign, at least the size of a scalar.
template <class T, int N>
[[nodiscard]] bool overlaps_itself(const View<T, N>& view, std::size_t apart) {
  for (int c = 0; c < N; ++c)
    for (int d = 0; d < c; ++d) {
      const auto a = reinterpret_cast<std::uintptr_t>(view.base(c)), b = reinterpret_cast<std::uintptr_t>(view.base(d));
      const std::uintptr_t distance = a > b ? a - b : b - a;
      if (distance % apart == 0 && distance / apart < view.size()) return true;
    }
  return false;
}
}  // namespace detail

/// Throws `InputError` unless `view`, called `name` in the message, describes valid memory: no component starts at
/// null, all addresses are aligned, and if the view is writable, no two of its numbers share memory. A read-only view
/// may have the stride 0, one value for all particles. Does not access the particles.
template <class T, int N>
void require_view(const View<T, N>& view, const char* name) {
  if (view.size() == 0) return;
  const std::ptrdiff_t stride = view.stride();
  const auto apart = static_cast<std::size_t>(stride < 0 ? -stride : stride);
  std::uintptr_t bits = view.size() > 1 ? static_cast<std::uintptr_t>(apart) : 0;
  bool null = false;
  for (int c = 0; c < N; ++c) {
    null = null || view.base(c) == nullptr;
    bits |= reinterpret_cast<std::uintptr_t>(view.base(c));
  }
  detail::require(!null, "hmps: the view of ", name, " has ", view.size(),
                  " particles but a null address; give it memory");
  detail::require(bits % alignof(T) == 0, "hmps: the view of ", name, " is not aligned: addresses and stride (", stride,
                  " bytes) must be multiples of ", alignof(T), "; copy the members of packed structs to arrays first");
  if constexpr (!std::is_const_v<T>) {
    detail::require(view.size() == 1 || apart >= sizeof(T), "hmps: the view of ", name,
                    " is writable, but its stride of ", stride,
                    " bytes puts several particles in one place; a scalar takes ", sizeof(T), " bytes");
    detail::require(!detail::overlaps_itself(view, view.size() > 1 ? apart : sizeof(T)), "hmps: the view of ", name,
                    " is writable, but several of its components lie in one place at a stride of ", stride,
                    " bytes; give each component an array of its own, and the stride in bytes from particle to "
                    "particle");
  }
}

/// Throws `InputError` unless `view`, called `name` in the message, is valid (`require_view`) and holds `size`
/// particles.
template <class T, int N>
void require_size(const View<T, N>& view, std::size_t size, const char* name) {
  detail::require(view.size() == size, "hmps: the view of ", name, " holds ", view.size(), " particles but ", size,
                  " are needed; give all views of one call the same particles");
  require_view(view, name);
}

/// Throws `InputError` if a writable view starts at the same address as another view, which would then change while it
/// is read. Does not detect views that overlap elsewhere.
template <class T, int N, class U, int M>
void require_apart(const View<T, N>& written, const char* name, const View<U, M>& other, const char* other_name) {
  detail::require(
      written.size() == 0 || static_cast<const void*>(written.base(0)) != static_cast<const void*>(other.base(0)),
      "hmps: the views of ", name, " and ", other_name, " are the same memory; give each an array of its own");
}

/// Throws `InputError` unless `view`, called `name`, is valid (`require_view`) and every particle is finite; names the
/// first that is not.
template <class T, int N>
void require_finite(const View<T, N>& view, const char* name) {
  require_view(view, name);
  for (std::size_t i = 0; i < view.size(); ++i)
    for (int c = 0; c < N; ++c)
      detail::require(detail::is_finite(view(i, c)), "hmps: component ", c, " of ", name, " of particle ", i, " is ",
                      view(i, c), "; every component must be a finite number");
}

}  // namespace hmps::inline HMPS_ABI
