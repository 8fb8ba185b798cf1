// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// A view of `N` scalars per particle in the user's memory: component `c` of particle `i` lies `i * stride` bytes after
/// `base(c)`. It describes arrays of structs, structs of arrays, Eigen maps and raw memory alike. Copying a view does
/// not copy the data. `T` is `const` for read-only views.
template <class T, int N>
class View {
 public:
  using Scalar = std::remove_const_t<T>;
  static constexpr int components = N;

  View() = default;

  /// A view of `size` particles whose components start at `base` and lie `stride` bytes apart.
  View(std::array<T*, std::size_t{N}> base, std::size_t size, std::ptrdiff_t stride)
      : base_(base), size_(size), stride_(stride) {}

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

  /// The particles `[first, first + count)` of this view. Throws `InputError` if the view ends before the last of them.
  [[nodiscard]] View part(std::size_t first, std::size_t count) const {
    detail::require(first <= size_ && count <= size_ - first, "hmps: the part of ", count, " particles from particle ",
                    first, " on is out of range: the view has ", size_,
                    " particles (indices start at 0); give the first particle, then their number");
    std::array<T*, std::size_t{N}> moved{};
    for (int c = 0; c < N; ++c) moved[static_cast<std::size_t>(c)] = count == 0 ? base(c) : &(*this)(first, c);
    return {moved, count, stride_};
  }

 private:
  std::array<T*, std::size_t{N}> base_{};
  std::size_t size_ = 0;
  std::ptrdiff_t stride_ = 0;
};

/// A view of one scalar per particle.
template <class T>
struct ScalarView : View<T, 1> {
  using View<T, 1>::View;
  ScalarView() = default;
  ScalarView(const View<T, 1>& view) : View<T, 1>(view) {}
  [[nodiscard]] T& operator[](std::size_t i) const { return (*this)(i, 0); }
  [[nodiscard]] ScalarView part(std::size_t first, std::size_t count) const { return View<T, 1>::part(first, count); }
};

/// A view of one `D`-vector per particle: positions, velocities, force densities.
template <class T, int D>
struct VectorView : View<T, D> {
  using typename View<T, D>::Scalar;
  using View<T, D>::View;
  static constexpr int dimension = D;
  VectorView() = default;
  VectorView(const View<T, D>& view) : View<T, D>(view) {}

  [[nodiscard]] VectorView part(std::size_t first, std::size_t count) const { return View<T, D>::part(first, count); }
  /// A copy of the vector of particle `i`, const so that `f[i] = v` and `f[i] += v`, which would change only the copy,
  /// do not compile. Write with `f.set(i, v)`, `f.add(i, v)` or `f(i, c)`.
  [[nodiscard]] const Vector<Scalar, D> operator[](std::size_t i) const {
    Vector<Scalar, D> value;
    for (int c = 0; c < D; ++c) value[c] = (*this)(i, c);
    return value;
  }
  /// Writes `value` to particle `i`.
  template <class Derived>
  void set(std::size_t i, const Eigen::MatrixBase<Derived>& value) const {
    for (int c = 0; c < D; ++c) (*this)(i, c) = static_cast<Scalar>(value[c]);
  }
  /// Adds `value` to particle `i`.
  template <class Derived>
  void add(std::size_t i, const Eigen::MatrixBase<Derived>& value) const {
    for (int c = 0; c < D; ++c) (*this)(i, c) += static_cast<Scalar>(value[c]);
  }
};

/// A view of one `D` by `D` tensor per particle, column-major: deformation gradients.
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
  /// A copy of the tensor of particle `i`, const for the same reason as that of a vector.
  [[nodiscard]] const Matrix<Scalar, D> operator[](std::size_t i) const {
    Matrix<Scalar, D> value;
    for (int c = 0; c < D * D; ++c) value(c % D, c / D) = (*this)(i, c);
    return value;
  }
  /// Writes `value` to particle `i`.
  template <class Derived>
  void set(std::size_t i, const Eigen::MatrixBase<Derived>& value) const {
    for (int c = 0; c < D * D; ++c) (*this)(i, c) = static_cast<Scalar>(value(c % D, c / D));
  }
  /// Adds `value` to particle `i`.
  template <class Derived>
  void add(std::size_t i, const Eigen::MatrixBase<Derived>& value) const {
    for (int c = 0; c < D * D; ++c) (*this)(i, c) += static_cast<Scalar>(value(c % D, c / D));
  }
};

}  // namespace hmps::inline HMPS_ABI
