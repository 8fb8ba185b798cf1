// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

#include "hmps/core/error.hpp"
#include "hmps/core/finite.hpp"
#include "hmps/core/types.hpp"

namespace hmps {

/// View of `N` scalars per particle in the user's own memory: component `c` of particle `i` lies
/// `i * stride` bytes behind `base(c)`. One shape for arrays of structs, structs of arrays, Eigen
/// maps and raw pointers. Copying a view copies no state. `T` is `const` for read-only views.
template <class T, int N>
class View {
 public:
  using Scalar = std::remove_const_t<T>;
  static constexpr int components = N;

  View() = default;

  /// A view of `size` particles whose components start at `base` and lie `stride` bytes apart.
  View(std::array<T*, N> base, std::size_t size, std::ptrdiff_t stride) : base_(base), size_(size), stride_(stride) {}

  /// A writable view converts to a read-only one.
  template <class U>
  requires std::same_as<T, const U> View(const View<U, N>& other) : size_(other.size()), stride_(other.stride()) {
    for (int c = 0; c < N; ++c) base_[static_cast<std::size_t>(c)] = other.base(c);
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }
  [[nodiscard]] T* base(int component) const { return base_[static_cast<std::size_t>(component)]; }

  /// Component `c` of particle `i`.
  [[nodiscard]] T& operator()(std::size_t i, int c) const {
    using Byte = std::conditional_t<std::is_const_v<T>, const char, char>;
    return *reinterpret_cast<T*>(reinterpret_cast<Byte*>(base(c)) + static_cast<std::ptrdiff_t>(i) * stride_);
  }

  /// The particles `[first, first + count)` of this view.
  [[nodiscard]] View part(std::size_t first, std::size_t count) const {
    std::array<T*, N> moved{};
    for (int c = 0; c < N; ++c) moved[static_cast<std::size_t>(c)] = count == 0 ? base(c) : &(*this)(first, c);
    return {moved, count, stride_};
  }

 private:
  std::array<T*, N> base_{};
  std::size_t size_ = 0;
  std::ptrdiff_t stride_ = 0;
};

/// View of one scalar per particle.
template <class T>
struct ScalarView : View<T, 1> {
  using View<T, 1>::View;
  ScalarView() = default;
  ScalarView(const View<T, 1>& view) : View<T, 1>(view) {}
  [[nodiscard]] T& operator[](std::size_t i) const { return (*this)(i, 0); }
  [[nodiscard]] ScalarView part(std::size_t first, std::size_t count) const { return View<T, 1>::part(first, count); }
};

/// View of one `D`-vector per particle: positions, velocities, force densities.
template <class T, int D>
struct VectorView : View<T, D> {
  using typename View<T, D>::Scalar;
  using View<T, D>::View;
  static constexpr int dimension = D;
  VectorView() = default;
  VectorView(const View<T, D>& view) : View<T, D>(view) {}

  [[nodiscard]] VectorView part(std::size_t first, std::size_t count) const { return View<T, D>::part(first, count); }
  /// The vector of particle `i`, by value.
  [[nodiscard]] Vector<Scalar, D> operator[](std::size_t i) const {
    Vector<Scalar, D> value;
    for (int c = 0; c < D; ++c) value[c] = (*this)(i, c);
    return value;
  }
  template <class Derived>
  void set(std::size_t i, const Eigen::MatrixBase<Derived>& value) const {
    for (int c = 0; c < D; ++c) (*this)(i, c) = static_cast<Scalar>(value[c]);
  }
  template <class Derived>
  void add(std::size_t i, const Eigen::MatrixBase<Derived>& value) const {
    for (int c = 0; c < D; ++c) (*this)(i, c) += static_cast<Scalar>(value[c]);
  }
};

/// View of one `D` by `D` tensor per particle, column-major: deformation gradients.
template <class T, int D>
struct MatrixView : View<T, D * D> {
  using typename View<T, D * D>::Scalar;
  using View<T, D * D>::View;
  static constexpr int dimension = D;
  MatrixView() = default;
  MatrixView(const View<T, D * D>& view) : View<T, D * D>(view) {}

  [[nodiscard]] MatrixView part(std::size_t first, std::size_t count) const {
    return View<T, D * D>::part(first, count);
  }
  /// The tensor of particle `i`, by value.
  [[nodiscard]] Matrix<Scalar, D> operator[](std::size_t i) const {
    Matrix<Scalar, D> value;
    for (int c = 0; c < D * D; ++c) value(c % D, c / D) = (*this)(i, c);
    return value;
  }
  template <class Derived>
  void set(std::size_t i, const Eigen::MatrixBase<Derived>& value) const {
    for (int c = 0; c < D * D; ++c) (*this)(i, c) = static_cast<Scalar>(value(c % D, c / D));
  }
};

namespace detail {

template <int N, class T>
[[nodiscard]] View<T, N> interleaved(T* first, std::size_t size, std::ptrdiff_t stride) {
  std::array<T*, N> base{};
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

/// An Eigen object over memory that outlives the call: no temporary that owns its numbers.
template <class M>
concept EigenView = std::derived_from<std::remove_cvref_t<M>, Eigen::DenseBase<std::remove_cvref_t<M>>> &&
    requires(M& m) {
  m.data();
  m.outerStride();
} &&(std::is_lvalue_reference_v<M> ||
     !std::derived_from<std::remove_cvref_t<M>, Eigen::PlainObjectBase<std::remove_cvref_t<M>>>);
template <class M>
concept Columns = M::RowsAtCompileTime == 2 || M::RowsAtCompileTime == 3;

}  // namespace detail

/// Vectors in a range of `Eigen::Vector3d`, `std::array<float, 2>`, … (anything that a `std::span`
/// can be made of).
template <detail::Elements R>
[[nodiscard]] auto vectors(R& range) {
  const std::span span(range);
  return detail::as_vectors(detail::elements(span.data(), span.size()));
}

/// Vectors in the member `pointer` of a range of the user's structs:
/// `vectors(particles, &Particle::position)`.
template <class R, class Class, class Member>
[[nodiscard]] auto vectors(R& range, Member Class::*pointer) {
  return detail::as_vectors(detail::member(std::span(range), pointer));
}

/// Vectors in one array per component (struct of arrays). Throws `InputError` if sizes differ.
template <class R, class... More>
requires(detail::Elements<R> && sizeof...(More) >= 1 && (detail::Elements<More> && ...))
    [[nodiscard]] auto vectors(R& first, More&... more) {
  const std::span x(first);
  using T = typename decltype(x)::element_type;
  ((require(std::span(more).size() == x.size(), "hmps: the component arrays of a vector view have ", x.size(), " and ",
            std::span(more).size(), " elements; give arrays of one size")),
   ...);
  constexpr int D = 1 + static_cast<int>(sizeof...(More));
  return VectorView<T, D>({x.data(), std::span(more).data()...}, x.size(), sizeof(T));
}

/// Vectors in the columns of an Eigen matrix, map or block with 2 or 3 rows at compile time. Maps and
/// blocks may be temporaries.
template <class M>
requires(detail::EigenView<M>&& detail::Columns<std::remove_cvref_t<M>>) [[nodiscard]] auto vectors(M&& columns) {
  using T = std::remove_pointer_t<decltype(columns.data())>;
  constexpr bool by_rows = std::remove_cvref_t<M>::IsRowMajor;
  constexpr int D = std::remove_cvref_t<M>::RowsAtCompileTime;
  const std::ptrdiff_t row = by_rows ? columns.outerStride() : columns.innerStride();
  const std::ptrdiff_t col = by_rows ? columns.innerStride() : columns.outerStride();
  std::array<T*, D> base{};
  for (int c = 0; c < D; ++c) base[static_cast<std::size_t>(c)] = columns.data() + c * row;
  return VectorView<T, D>(base, static_cast<std::size_t>(columns.cols()), col * static_cast<std::ptrdiff_t>(sizeof(T)));
}

/// Vectors of `D` components, the first at `first`, `stride` bytes from particle to particle.
template <int D, class T>
[[nodiscard]] VectorView<T, D> vectors(T* first, std::size_t size, std::ptrdiff_t stride = D * sizeof(T)) {
  return detail::interleaved<D>(first, size, stride);
}

/// Tensors in a range of `Eigen::Matrix3d`, `std::array<float, 9>` (column-major), ….
template <detail::Elements R>
[[nodiscard]] auto matrices(R& range) {
  const std::span span(range);
  return detail::as_matrices(detail::elements(span.data(), span.size()));
}

/// Tensors in the member `pointer` of a range of the user's structs.
template <class R, class Class, class Member>
[[nodiscard]] auto matrices(R& range, Member Class::*pointer) {
  return detail::as_matrices(detail::member(std::span(range), pointer));
}

/// Scalars in a contiguous range.
template <detail::Elements R>
[[nodiscard]] auto scalars(R& range) {
  const std::span span(range);
  using T = typename decltype(span)::element_type;
  return ScalarView<T>(detail::elements(span.data(), span.size()));
}

/// Scalars in an Eigen vector, map or segment.
template <class M>
requires(detail::EigenView<M>&& bool(std::remove_cvref_t<M>::IsVectorAtCompileTime))
    [[nodiscard]] auto scalars(M&& values) {
  using T = std::remove_pointer_t<decltype(values.data())>;
  return ScalarView<T>({values.data()}, static_cast<std::size_t>(values.size()),
                       values.innerStride() * static_cast<std::ptrdiff_t>(sizeof(T)));
}

/// Scalars in the member `pointer` of a range of the user's structs.
template <class R, class Class, class Member>
[[nodiscard]] auto scalars(R& range, Member Class::*pointer) {
  const auto view = detail::member(std::span(range), pointer);
  using T = std::remove_pointer_t<decltype(view.base(0))>;
  return ScalarView<T>(view);
}

/// Throws `InputError` unless `view`, called `name` in the message, holds `size` particles.
template <class T, int N>
void require_size(const View<T, N>& view, std::size_t size, const char* name) {
  require(view.size() == size, "hmps: the view of ", name, " holds ", view.size(), " particles but ", size,
          " are needed; give every view of one call the same particles");
}

/// Throws `InputError` at the first particle of `view`, called `name`, with a NaN or an infinity.
template <class T, int N>
void require_finite(const View<T, N>& view, const char* name) {
  for (std::size_t i = 0; i < view.size(); ++i)
    for (int c = 0; c < N; ++c)
      require(detail::is_finite(view(i, c)), "hmps: component ", c, " of ", name, " of particle ", i, " is ",
              view(i, c), "; every component must be a finite number");
}

}  // namespace hmps
