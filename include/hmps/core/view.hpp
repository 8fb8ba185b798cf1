// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view_checks.hpp"
#include "hmps/core/view_types.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

template <int N, class T>
[[nodiscard]] View<T, N> interleaved(T* first, std::size_t size, std::ptrdiff_t stride) {
  std::array<T*, std::size_t{N}> base{};
  for (int c = 0; c < N; ++c) base[static_cast<std::size_t>(c)] = first == nullptr ? nullptr : first + c;
  return {base, size, stride};
}

/// The scalar type and the number of scalars of a contiguous member such as `double[3]`,
/// `std::array<float, 2>` or `Eigen::Vector3d`.
template <class M>
struct MemberTraits;
template <class S, std::size_t N>
struct MemberTraits<S[N]> {
  using Scalar = S;
  static constexpr int size = static_cast<int>(N);
};
template <class S, std::size_t N>
struct MemberTraits<std::array<S, N>> {
  using Scalar = S;
  static constexpr int size = static_cast<int>(N);
};
template <class S, int R, int C, int O, int MR, int MC>
struct MemberTraits<Eigen::Matrix<S, R, C, O, MR, MC>> {
  static_assert(R > 0 && C > 0, "hmps: a member that is viewed needs a fixed size");
  static_assert(C == 1 || R == 1 || !(O & Eigen::RowMajor), "hmps: a viewed tensor must be column-major");
  using Scalar = S;
  static constexpr int size = R * C;
};
template <class S>
requires std::is_arithmetic_v<S>
struct MemberTraits<S> {
  using Scalar = S;
  static constexpr int size = 1;
};

[[nodiscard]] constexpr int root(int n) { return n == 4 ? 2 : n == 9 ? 3 : -1; }

/// `T` with the constness of `From`.
template <class From, class T>
using Like = std::conditional_t<std::is_const_v<From>, const T, T>;

template <class Element>
[[nodiscard]] auto elements(Element* first, std::size_t size) {
  using Traits = MemberTraits<std::remove_const_t<Element>>;
  static_assert(sizeof(Element) == sizeof(typename Traits::Scalar) * static_cast<std::size_t>(Traits::size));
  using T = Like<Element, typename Traits::Scalar>;
  return interleaved<Traits::size>(reinterpret_cast<T*>(first), size, static_cast<std::ptrdiff_t>(sizeof(Element)));
}

template <class Struct, class Class, class Member>
[[nodiscard]] auto member(std::span<Struct> particles, Member Class::*pointer) {
  using Traits = MemberTraits<Member>;
  using T = Like<Struct, typename Traits::Scalar>;
  T* first = particles.empty() ? nullptr : reinterpret_cast<T*>(&(particles.front().*pointer));
  return interleaved<Traits::size>(first, particles.size(), static_cast<std::ptrdiff_t>(sizeof(Struct)));
}

template <class T, int N>
[[nodiscard]] VectorView<T, N> as_vectors(const View<T, N>& view) {
  static_assert(N == 2 || N == 3, "hmps: positions, velocities and forces have 2 or 3 components");
  return view;
}
template <class T, int N>
[[nodiscard]] auto as_matrices(const View<T, N>& view) {
  static_assert(root(N) > 0, "hmps: a deformation gradient has 2 x 2 or 3 x 3 components");
  return MatrixView<T, root(N)>(view);
}

template <class R>
concept Elements = requires(R& range) {
  std::span(range);
  typename MemberTraits<std::remove_const_t<typename decltype(std::span(range))::element_type>>::Scalar;
};

/// An Eigen object whose numbers outlive the expression, as opposed to a temporary that owns them.
template <class M>
concept EigenView = std::derived_from<std::remove_cvref_t<M>, Eigen::DenseBase<std::remove_cvref_t<M>>> &&
    requires(M& m) {
  m.data();
  m.outerStride();
} &&(std::is_lvalue_reference_v<M> ||
     !std::derived_from<std::remove_cvref_t<M>, Eigen::PlainObjectBase<std::remove_cvref_t<M>>>);
template <class M>
concept Columns = M::RowsAtCompileTime == 2 || M::RowsAtCompileTime == 3;

/// An array of the user's that is not wrapped in a view.
template <class A>
concept Unwrapped = std::derived_from<A, Eigen::DenseBase<A>> || requires(const A& array) {
  requires Elements<const A>;
  requires std::floating_point<
      typename MemberTraits<std::remove_const_t<typename decltype(std::span(array))::element_type>>::Scalar>;
};
/// A trait, because clang names the type in the message for a trait, but not for a concept.
template <class... Arguments>
struct AreWrapped : std::bool_constant<!(Unwrapped<Arguments> || ...)> {};
/// Fails to compile for arrays in place of views; the first line of the message names them. It is the result of
/// overloads that are only declared, `requires(!AreWrapped<Arguments...>::value)`, for the calls that users write most.
template <class... Arguments>
struct RequireViews {
  static_assert(AreWrapped<Arguments...>::value,
                "hmps: this call takes views of arrays, not arrays: wrap arrays of vectors in hmps::vectors(array), of "
                "tensors in hmps::matrices(array), of numbers in hmps::scalars(array)");
};

}  // namespace detail

/// A view of vectors in a range of `Eigen::Vector3d`, `std::array<float, 2>`, … (anything convertible to `std::span`).
template <detail::Elements R>
[[nodiscard]] auto vectors(R& range) {
  const std::span span(range);
  return detail::as_vectors(detail::elements(span.data(), span.size()));
}

/// A view of vectors in the member `pointer` of a range of structs: `vectors(particles, &Particle::position)`.
template <class R, class Class, class Member>
[[nodiscard]] auto vectors(R& range, Member Class::*pointer) {
  return detail::as_vectors(detail::member(std::span(range), pointer));
}

/// A view of vectors stored as one array per component (struct of arrays). Throws `InputError` if sizes differ.
template <class R, class... More>
requires(detail::Elements<R> && sizeof...(More) >= 1 && (detail::Elements<More> && ...))
    [[nodiscard]] auto vectors(R& first, More&... more) {
  const std::span x(first);
  using T = typename decltype(x)::element_type;
  ((detail::require(std::span(more).size() == x.size(), "hmps: the component arrays of a vector view have ", x.size(),
                    " and ", std::span(more).size(), " elements; give arrays of equal size")),
   ...);
  constexpr int D = 1 + static_cast<int>(sizeof...(More));
  return VectorView<T, D>({x.data(), std::span(more).data()...}, x.size(), sizeof(T));
}

/// A view of vectors in the columns of an Eigen matrix, map or block with 2 or 3 rows at compile time. Maps and blocks
/// may be temporaries.
template <class M>
requires(detail::EigenView<M>&& detail::Columns<std::remove_cvref_t<M>>) [[nodiscard]] auto vectors(M&& columns) {
  using T = std::remove_pointer_t<decltype(columns.data())>;
  constexpr bool by_rows = std::remove_cvref_t<M>::IsRowMajor;
  constexpr int D = std::remove_cvref_t<M>::RowsAtCompileTime;
  const std::ptrdiff_t row = by_rows ? columns.outerStride() : columns.innerStride();
  const std::ptrdiff_t col = by_rows ? columns.innerStride() : columns.outerStride();
  std::array<T*, std::size_t{D}> base{};
  for (int c = 0; c < D; ++c) base[static_cast<std::size_t>(c)] = columns.data() + c * row;
  return VectorView<T, D>(base, static_cast<std::size_t>(columns.cols()), col * static_cast<std::ptrdiff_t>(sizeof(T)));
}

/// A view of vectors of `D` components in raw memory: the first one at `first`, `stride` bytes from particle to
/// particle.
template <int D, class T>
[[nodiscard]] VectorView<T, D> vectors(T* first, std::size_t size, std::ptrdiff_t stride = D * sizeof(T)) {
  return detail::interleaved<D>(first, size, stride);
}

/// A view of tensors in a range of `Eigen::Matrix3d`, `std::array<float, 9>` (column-major), ….
template <detail::Elements R>
[[nodiscard]] auto matrices(R& range) {
  const std::span span(range);
  return detail::as_matrices(detail::elements(span.data(), span.size()));
}

/// A view of tensors in the member `pointer` of a range of structs.
template <class R, class Class, class Member>
[[nodiscard]] auto matrices(R& range, Member Class::*pointer) {
  return detail::as_matrices(detail::member(std::span(range), pointer));
}

/// A view of scalars in a contiguous range.
template <detail::Elements R>
[[nodiscard]] auto scalars(R& range) {
  const std::span span(range);
  using T = typename decltype(span)::element_type;
  return ScalarView<T>(detail::elements(span.data(), span.size()));
}

/// A view of scalars in an Eigen vector, map or segment.
template <class M>
requires(detail::EigenView<M>&& bool(std::remove_cvref_t<M>::IsVectorAtCompileTime))
    [[nodiscard]] auto scalars(M&& values) {
  using T = std::remove_pointer_t<decltype(values.data())>;
  return ScalarView<T>({values.data()}, static_cast<std::size_t>(values.size()),
                       values.innerStride() * static_cast<std::ptrdiff_t>(sizeof(T)));
}

/// A view of scalars in the member `pointer` of a range of structs.
template <class R, class Class, class Member>
[[nodiscard]] auto scalars(R& range, Member Class::*pointer) {
  const auto view = detail::member(std::span(range), pointer);
  using T = std::remove_pointer_t<decltype(view.base(0))>;
  return ScalarView<T>(view);
}

/// Sets all numbers of `view` to zero: velocities at the start, or force densities before `MetaballContact::add`.
/// Throws `InputError` for an invalid view (`require_view`).
template <class T, int N, Executor E = Serial>
void set_zero(const View<T, N>& view, const E& execute = {}) {
  static_assert(!std::is_const_v<T>, "hmps: set_zero writes; give it a writable view");
  require_view(view, "numbers to be set to zero");
  detail::guarded(execute)(view.size(), [&](std::size_t i) {
    for (int c = 0; c < N; ++c) view(i, c) = T(0);
  });
}

/// Explains calls with arrays in place of views.
template <class... Arguments>
requires(!detail::AreWrapped<Arguments...>::value) detail::RequireViews<Arguments...> set_zero(const Arguments&...);

}  // namespace hmps::inline HMPS_ABI
