// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

/// The internal forces of the paper evaluated literally: each equation apart, one particle and one
/// neighbour after the other, with Eigen and nothing of hmps. What the library is compared with, in
/// its tests for the numbers and in its benchmarks for the time.
namespace plain {

/// A body in its reference configuration: its bonds in compressed rows.
template <class S, int D>
class Body {
 public:
  using Vec = Eigen::Matrix<S, D, 1>;
  using Mat = Eigen::Matrix<S, D, D>;
  struct Bond {
    std::size_t j;
    Vec r0;
    S w;
  };

  template <class Bonded>
  Body(const std::vector<Vec>& reference, S radius, Bonded&& bonded) : offset_(1, 0) {
    std::unordered_map<std::int64_t, std::vector<std::size_t>> cells;
    for (std::size_t i = 0; i < reference.size(); ++i) cells[key(cell(reference[i], radius))].push_back(i);
    for (std::size_t i = 0; i < reference.size(); ++i) {
      Mat A = Mat::Zero();
      S trace = 0;
      std::array<std::int64_t, D> step;
      for (step.fill(-1);;) {
        auto near = cell(reference[i], radius);
        for (std::size_t d = 0; d < D; ++d) near[d] += step[d];
        if (const auto found = cells.find(key(near)); found != cells.end()) {
          for (std::size_t j : found->second) {
            const Vec r0 = reference[j] - reference[i];
            const S distance = r0.norm();
            if (j == i || distance > radius || !bonded(i, j)) continue;
            const S w = radius / distance - S(1);  // Eq. (8)
            bonds_.push_back({j, r0, w});
            A += r0 * r0.transpose() * w;  // Eq. (12)
            trace += r0.squaredNorm() * w;
          }
        }
        std::size_t d = 0;
        while (d < D && step[d] == 1) step[d++] = -1;
        if (d == D) break;
        ++step[d];
      }
      offset_.push_back(bonds_.size());
      inverse_.push_back(A.inverse());
      trace_.push_back(trace);
    }
  }
  Body(const std::vector<Vec>& reference, S radius)
      : Body(reference, radius, [](std::size_t, std::size_t) { return true; }) {}

  [[nodiscard]] std::size_t size() const { return inverse_.size(); }
  [[nodiscard]] std::size_t neighbours(std::size_t i) const { return offset_[i + 1] - offset_[i]; }
  [[nodiscard]] const Mat& shape_inverse(std::size_t i) const { return inverse_[i]; }
  [[nodiscard]] S shape_trace(std::size_t i) const { return trace_[i]; }

  /// Calls `visit(bond)` for each bond of particle `i`.
  template <class Visit>
  void for_each_bond(std::size_t i, Visit&& visit) const {
    for (std::size_t k = offset_[i]; k < offset_[i + 1]; ++k) visit(bonds_[k]);
  }

  /// Eq. (11).
  void deformation_gradient(const std::vector<Vec>& x, std::vector<Mat>& F) const {
    for (std::size_t i = 0; i < size(); ++i) {
      Mat sum = Mat::Zero();
      for_each_bond(i, [&](const Bond& b) { sum += (x[b.j] - x[i]) * b.r0.transpose() * b.w; });
      F[i] = sum * inverse_[i];
    }
  }

  /// Eq. (13), added to `f`, with S_i = `stress(i, F_i)`, the second Piola-Kirchhoff stress.
  template <class Stress>
  void elastic(const std::vector<Mat>& F, Stress&& stress, std::vector<Vec>& f) const {
    std::vector<Mat> carried(size());
    for (std::size_t i = 0; i < size(); ++i) carried[i] = F[i] * stress(i, F[i]) * inverse_[i];
    for (std::size_t i = 0; i < size(); ++i)
      for_each_bond(i, [&](const Bond& b) { f[i] += (carried[i] * b.r0 + carried[b.j] * b.r0) * b.w; });
  }

  /// Eqs. (19) and (20), added to `f`, with E_hat_i = `modulus(i)`.
  template <class Modulus>
  void artificial(const std::vector<Vec>& x, const std::vector<Mat>& F, Modulus&& modulus, std::vector<Vec>& f) const {
    std::vector<S> C(size());
    for (std::size_t i = 0; i < size(); ++i) C[i] = modulus(i) * S(D) / trace_[i];
    for (std::size_t i = 0; i < size(); ++i)
      for_each_bond(i, [&](const Bond& b) {
        const Vec r = x[b.j] - x[i];
        f[i] += (C[i] * (r - F[i] * b.r0) + C[b.j] * (r - F[b.j] * b.r0)) * b.w;
      });
  }

  /// Eq. (21), added to `f`.
  void viscous(const std::vector<Vec>& v, S density, S viscosity, S lambda, S n0, std::vector<Vec>& f) const {
    const S factor = density * viscosity * S(2 * D) / (lambda * n0);
    for (std::size_t i = 0; i < size(); ++i)
      for_each_bond(i, [&](const Bond& b) { f[i] += factor * (v[b.j] - v[i]) * b.w; });
  }

  /// Energy density of Eqs. (9) and (20), C_i / 2 sum |r_ij - F_i r0_ij|^2 w_ij, whose gradient Eq. (19) is.
  template <class Modulus>
  [[nodiscard]] S artificial_energy(std::size_t i, const std::vector<Vec>& x, const Mat& F, Modulus&& modulus) const {
    S e = 0;
    for_each_bond(i, [&](const Bond& b) { e += ((x[b.j] - x[i]) - F * b.r0).squaredNorm() * b.w; });
    return modulus(i) * S(D) / trace_[i] / S(2) * e;
  }

 private:
  static std::array<std::int64_t, D> cell(const Vec& x, S width) {
    std::array<std::int64_t, D> place;
    for (std::size_t d = 0; d < D; ++d)
      place[d] = static_cast<std::int64_t>(std::floor(x[static_cast<Eigen::Index>(d)] / width));
    return place;
  }
  static std::int64_t key(const std::array<std::int64_t, D>& place) {
    std::int64_t k = 0;
    for (std::int64_t p : place) k = k * (std::int64_t{1} << 20) + p;
    return k;
  }

  std::vector<std::size_t> offset_;
  std::vector<Bond> bonds_;
  std::vector<Mat> inverse_;
  std::vector<S> trace_;
};

/// The law of Eqs. (15) to (17) differentiated by hand, Eq. (14); plane strain in two dimensions.
template <class S>
struct MooneyRivlin {
  S c1, c2, d1;

  template <int D>
  [[nodiscard]] Eigen::Matrix<S, D, D> second_piola_kirchhoff(const Eigen::Matrix<S, D, D>& F) const {
    using Mat3 = Eigen::Matrix<S, 3, 3>;
    const Mat3 G = in_space<D>(F), C = G.transpose() * G, inverse = C.inverse(), unit = Mat3::Identity();
    const S J = G.determinant(), I1 = C.trace(), I2 = (I1 * I1 - (C * C).trace()) / S(2);
    const Mat3 stress = S(2) * c1 * std::pow(J, S(-2) / S(3)) * (unit - I1 / S(3) * inverse) +
                        S(2) * c2 * std::pow(J, S(-4) / S(3)) * (I1 * unit - C - S(2) / S(3) * I2 * inverse) +
                        S(2) * d1 * (J - S(1)) * J * inverse;
    return stress.template topLeftCorner<D, D>();
  }
  template <int D>
  [[nodiscard]] S energy(const Eigen::Matrix<S, D, D>& F) const {
    using Mat3 = Eigen::Matrix<S, 3, 3>;
    const Mat3 G = in_space<D>(F), C = G.transpose() * G;
    const S J = G.determinant(), I1 = C.trace(), I2 = (I1 * I1 - (C * C).trace()) / S(2);
    return c1 * (std::pow(J, S(-2) / S(3)) * I1 - S(3)) + c2 * (std::pow(J, S(-4) / S(3)) * I2 - S(3)) +
           d1 * (J - S(1)) * (J - S(1));
  }

 private:
  template <int D>
  [[nodiscard]] static Eigen::Matrix<S, 3, 3> in_space(const Eigen::Matrix<S, D, D>& F) {
    Eigen::Matrix<S, 3, 3> G = Eigen::Matrix<S, 3, 3>::Identity();
    G.template topLeftCorner<D, D>() = F;
    return G;
  }
};

}  // namespace plain
