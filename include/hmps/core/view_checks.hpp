// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/finite.hpp"
#include "hmps/core/view_types.hpp"

namespace hmps::inline HMPS_ABI {

/// Throws `InputError` unless the memory that `view`, called `name` in the message, describes can be one: no component
/// starts at null, addresses are aligned as the scalar must be, and of what is written no two particles share memory. A
/// view that is only read may have the stride 0, one value for all. Looks at no particle.
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
  require(!null, "hmps: the view of ", name, " has ", view.size(), " particles at the address null; give it memory");
  require(bits % alignof(T) == 0, "hmps: the view of ", name, " is not aligned: addresses and stride (", stride,
          " bytes) must be multiples of ", alignof(T), "; take the members of packed structs out first");
  if constexpr (!std::is_const_v<T>)
    require(view.size() == 1 || apart >= sizeof(T), "hmps: the view of ", name, " is written, but its stride of ",
            stride, " bytes puts several particles in one place; a scalar takes ", sizeof(T), " bytes");
}

/// Throws `InputError` unless `view`, called `name` in the message, holds `size` particles, and as `require_view` does.
template <class T, int N>
void require_size(const View<T, N>& view, std::size_t size, const char* name) {
  require(view.size() == size, "hmps: the view of ", name, " holds ", view.size(), " particles but ", size,
          " are needed; give every view of one call the same particles");
  require_view(view, name);
}

/// Throws `InputError` if two views begin at the same address, though the first is written: what is read through the
/// other would change on the way. Does not see views that overlap elsewhere.
template <class T, int N, class U, int M>
void require_apart(const View<T, N>& written, const char* name, const View<U, M>& other, const char* other_name) {
  require(written.size() == 0 || static_cast<const void*>(written.base(0)) != static_cast<const void*>(other.base(0)),
          "hmps: the views of ", name, " and ", other_name, " are the same memory; give each an array of its own");
}

/// Throws `InputError` at the first particle of `view`, called `name`, with a NaN or an infinity, and as `require_view`
/// does.
template <class T, int N>
void require_finite(const View<T, N>& view, const char* name) {
  require_view(view, name);
  for (std::size_t i = 0; i < view.size(); ++i)
    for (int c = 0; c < N; ++c)
      require(detail::is_finite(view(i, c)), "hmps: component ", c, " of ", name, " of particle ", i, " is ",
              view(i, c), "; every component must be a finite number");
}

}  // namespace hmps::inline HMPS_ABI
