// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "hmps/core/types.hpp"
#include "hmps/lanes/lanes.hpp"

namespace hmps {

namespace detail {

/// How many numbers make a piece: the 16 bytes within which every instruction set can rearrange a register.
template <class T>
inline constexpr std::size_t piece = 16 / sizeof(T);

#if defined(__GNUC__) || defined(__clang__)

template <class Half, int... k>
HMPS_INLINE auto join(const Half& a, const Half& b, std::integer_sequence<int, k...>) {
  return __builtin_shufflevector(a, b, k...);
}
/// A register of `pieces`, the p-th of which lies at `address(p)`.
template <class T, int pieces, class Address>
HMPS_INLINE auto load_pieces(const Address& address, int first = 0) {
  if constexpr (pieces == 1) {
    typename Register<T, 16>::Vector x;
    __builtin_memcpy(&x, address(first), sizeof(x));
    return x;
  } else {
    constexpr int half = pieces / 2, numbers = pieces * static_cast<int>(piece<T>);
    return join(load_pieces<T, half>(address, first), load_pieces<T, half>(address, first + half),
                std::make_integer_sequence<int, numbers>{});
  }
}

template <class T, bool second, class Vector, int... k>
HMPS_INLINE Vector zip(const Vector& a, const Vector& b, std::integer_sequence<int, k...>) {
  constexpr int width = sizeof...(k), size = static_cast<int>(piece<T>), half = second ? size / 2 : 0;
  return __builtin_shufflevector(a, b, (k % 2 * width + k / size * size + half + k % size / 2)...);
}
/// Of each piece of `a` and of `b`, the numbers of the first (or second) half in turn.
template <class T, bool second>
HMPS_INLINE auto zip(const typename Register<T>::Vector& a, const typename Register<T>::Vector& b) {
  return zip<T, second>(a, b, std::make_integer_sequence<int, Register<T>::width>{});
}

/// Fetches a piece of each record, from place `first` on, and puts its numbers into the lanes from `l` on of the
/// components, as far as there are such.
template <std::size_t pitch, std::size_t first, class T, std::size_t N>
HMPS_INLINE void gather_piece(const T* records, const Index* index, int l, std::array<Lanes<T>, N>& components) {
  using Vector = typename Register<T>::Vector;
  constexpr std::size_t size = piece<T>;
  // The pieces of row[k] are those of the lanes k, k + size and so on: with each piece transposed, lanes are in order.
  Vector row[size], column[size];
  for (std::size_t k = 0; k < size; ++k)
    row[k] = load_pieces<T, Register<T>::width / static_cast<int>(size)>([&](int p) HMPS_INLINE_LAMBDA {
      return records + index[static_cast<std::size_t>(l + p * static_cast<int>(size)) + k] * pitch + first;
    });
  if constexpr (size == 2) {
    column[0] = zip<T, false>(row[0], row[1]);
    column[1] = zip<T, true>(row[0], row[1]);
  } else {
    const Vector even[] = {zip<T, false>(row[0], row[2]), zip<T, true>(row[0], row[2])};
    const Vector odd[] = {zip<T, false>(row[1], row[3]), zip<T, true>(row[1], row[3])};
    for (std::size_t c = 0; c < 2; ++c) {
      column[2 * c] = zip<T, false>(even[c], odd[c]);
      column[2 * c + 1] = zip<T, true>(even[c], odd[c]);
    }
  }
  for (std::size_t c = 0; c < size && first + c < N; ++c)
    __builtin_memcpy(components[first + c].lane + l, &column[c], sizeof(Vector));
}

template <std::size_t pitch, class T, std::size_t N, std::size_t... place>
HMPS_INLINE void gather_pieces(const T* records, const Index* index, std::array<Lanes<T>, N>& components,
                               std::index_sequence<place...>) {
#pragma GCC unroll 4
  for (int l = 0; l < Lanes<T>::width; l += Register<T>::width)
    (gather_piece<pitch, place * piece<T>>(records, index, l, components), ...);
}

#endif

}  // namespace detail

/// How many numbers apart records of `numbers` lie: whole pieces, of which they are fetched; a single number needs
/// none.
template <class T>
[[nodiscard]] constexpr std::size_t record_pitch(std::size_t numbers) {
  return numbers == 1 ? 1 : (numbers + detail::piece<T> - 1) / detail::piece<T> * detail::piece<T>;
}

/// The records at the places `index[0]`, `index[1]` and so on, one in each lane: `[c]` of what is returned are their
/// numbers at place c. Records lie `record_pitch<T>(N)` apart.
template <std::size_t N, class T>
[[nodiscard]] HMPS_INLINE std::array<Lanes<T>, N> gather_records(const T* records, const Index* index) {
  constexpr std::size_t pitch = record_pitch<T>(N);
  std::array<Lanes<T>, N> components;
#if defined(__GNUC__) || defined(__clang__)
  if constexpr (N > 1) {
    detail::gather_pieces<pitch>(records, index, components, std::make_index_sequence<pitch / detail::piece<T>>{});
    return components;
  }
#endif
  for (std::size_t c = 0; c < N; ++c)
    components[c] = lanes_of<T>([&](int l) HMPS_INLINE_LAMBDA { return records[index[l] * pitch + c]; });
  return components;
}

}  // namespace hmps
