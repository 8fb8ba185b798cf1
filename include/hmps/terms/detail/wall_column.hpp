// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hmps/bonds/weight.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/wall_layers.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Energies of a flat wall that is twisted or bent by a curvature of one: those of one particle in each layer, averaged
/// over the particles of the layer. Lengths are in spacings, moduli in shear moduli.
template <class Real>
class WallColumn {
 public:
  /// `fill(add)` calls add(layer, weight, visit) for the particles of the wall, whose weights sum to one in each layer.
  /// `visit(bond)` calls bond(r, height, other) for every neighbour, with the vector to it, its height over the middle
  /// of the wall, and its layer.
  template <class Fill>
  WallColumn(int layers, Real apart, const Fill& fill) : layers_(layers), apart_(apart) {
    shear_ = volume_ = misfit_ = Form::Zero(layers + 1, layers + 1);
    bonds_ = Form::Zero(layers, layers);
    traces_ = Form::Zero(layers, layers + 1);
    fill([this](int layer, Real weight, const auto& visit) { this->add(layer, weight, visit); });
    take_means();
  }

  /// The energy of twist over the exact one, kappa^2 t^2 / 6 per volume, with `artificial` for E_hat.
  [[nodiscard]] Real twist(Real artificial) const {
    return (twist_strain_ + artificial * twist_misfit_) / (cube() / 3);
  }
  /// The E_hat with which `twist` is one.
  [[nodiscard]] Real artificial() const { return (cube() / 3 - twist_strain_) / twist_misfit_; }

  /// The energy of bending in plane strain over the exact one, E / (1 - nu^2) kappa^2 t^2 / 24 per volume, with the
  /// bulk moduli `law` of the law and `mean` of the mean dilatation, whose mean is taken twice. Layers are free to move
  /// across the wall.
  [[nodiscard]] Real plate(Real artificial, Real law, Real mean) const {
    const Real bulk = law + mean, modulus = 4 * (bulk + Real(1) / 3) / (bulk + Real(4) / 3);
    return released(form(artificial, law, mean), layers_ - 1) / (modulus * cube() / 24);
  }
  /// The same for a strip, which is also free to bend across: the exact energy is E kappa^2 t^2 / 24 per volume.
  [[nodiscard]] Real strip(Real artificial, Real law, Real mean) const {
    const Real bulk = law + mean, modulus = 9 * bulk / (3 * bulk + 1);
    return released(form(artificial, law, mean), layers_) / (modulus * cube() / 24);
  }

 private:
  /// Row and column 0 belong to the bending, k to a displacement of layer k by one across the wall, and the last to a
  /// bending about the other axis, in the opposite sense.
  static constexpr int most_fields = most_layers + 1;
  using Form = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_fields, most_fields>;
  using Matrix3 = Matrix<Real, 3>;
  using Vector3 = Vector<Real, 3>;

  [[nodiscard]] Real cube() const { return std::pow(Real(layers_), 3) * apart_ * apart_; }

  [[nodiscard]] Form form(Real artificial, Real law, Real mean) const {
    return shear_ + law * volume_ + artificial * misfit_ + mean * mean_;
  }
  /// The least energy of the bending when the next `free` fields are free.
  [[nodiscard]] static Real released(const Form& all, int free) {
    const Form q = all.block(1, 0, free, 1);
    return all(0, 0) - q.cwiseProduct(Form(all.block(1, 1, free, free).llt().solve(q))).sum();
  }

  template <class Visit>
  void add(int layer, Real weight, const Visit& visit) {
    Matrix3 A = Matrix3::Zero();
    std::array<Matrix3, 2> B_twist{A, A};  // of two twists, the second turned by 45 degrees
    std::array<Real, 2> square_twist{0, 0};
    std::array<Matrix3, std::size_t{most_fields}> B;
    B.fill(A);
    Form squares = Form::Zero(layers_ + 1, layers_ + 1);
    visit([&](const Vector3& r, Real height, int other) {
      const Real w = PaperWeight{}(r.norm(), Real(paper_radius_ratio));
      if (!(w > 0)) return;
      A += w * r * r.transpose();
      const std::array<Vector3, 2> twist{Vector3(-r[1] * height, -r[0] * height, r[0] * r[1]),
                                         Vector3(-r[0] * height, r[1] * height, (r[0] * r[0] - r[1] * r[1]) / 2)};
      for (std::size_t m = 0; m < 2; ++m) {
        B_twist[m] += w * twist[m] * r.transpose();
        square_twist[m] += w * twist[m].squaredNorm();
      }
      bonds_(layer, other) += weight;
      for (int a = 0; a <= layers_; ++a) {
        const Vector3 u = displacement(a, r, height, layer, other);
        B[static_cast<std::size_t>(a)] += w * u * r.transpose();
        for (int b = 0; b <= layers_; ++b) squares(a, b) += w * u.dot(displacement(b, r, height, layer, other));
      }
    });
    bonds_(layer, layer) += weight;  // the mean dilatation is over the particle and its neighbours
    const Matrix3 inverse = A.inverse();
    const Real misfit = weight * Real(1.5) / A.trace();
    for (std::size_t m = 0; m < 2; ++m) {
      const Matrix3 G = B_twist[m] * inverse;
      twist_strain_ += weight * (G + G.transpose()).squaredNorm() / 4;
      twist_misfit_ += misfit * (square_twist[m] - G.cwiseProduct(B_twist[m]).sum());
    }
    std::array<Matrix3, std::size_t{most_fields}> G;
    for (std::size_t a = 0; a <= static_cast<std::size_t>(layers_); ++a) G[a] = B[a] * inverse;
    for (int a = 0; a <= layers_; ++a) {
      const Matrix3& Ga = G[static_cast<std::size_t>(a)];
      traces_(layer, a) += weight * Ga.trace();
      for (int b = 0; b <= layers_; ++b) {
        const Matrix3& Gb = G[static_cast<std::size_t>(b)];
        const Real traces = Ga.trace() * Gb.trace();
        shear_(a, b) += weight * ((Ga + Ga.transpose()).cwiseProduct(Gb + Gb.transpose()).sum() / 4 - traces / 3);
        volume_(a, b) += weight * traces / 2;
        misfit_(a, b) += misfit * (squares(a, b) - Ga.cwiseProduct(B[static_cast<std::size_t>(b)]).sum());
      }
    }
  }

  /// The displacement, in field `a`, of a neighbour in layer `other` relative to a particle of `layer`.
  [[nodiscard]] Vector3 displacement(int a, const Vector3& r, Real height, int layer, int other) const {
    if (a == 0) return {-r[0] * height, 0, r[0] * r[0] / 2};
    if (a == layers_) return {0, r[1] * height, -r[1] * r[1] / 2};
    return {0, 0, Real((other == a) - (layer == a))};
  }

  /// The form of the mean dilatation, from the bonds between the layers, with the means of `MeanDilatation`.
  void take_means() {
    Form d = Form::Ones(layers_, 1);
    constexpr int enough = 200;
    for (int k = 0; k < enough; ++k) d = d.cwiseQuotient(Form(bonds_ * d)).cwiseSqrt().eval();
    const Form mean = d.asDiagonal() * bonds_ * d.asDiagonal();
    const Form dilatation = mean * mean * traces_;
    mean_ = dilatation.transpose() * dilatation / 2;
  }

  int layers_;
  Real apart_;
  Real twist_strain_ = 0, twist_misfit_ = 0;
  Form shear_, volume_, misfit_, mean_;
  Form bonds_;   // how many neighbours a particle of a layer has in another
  Form traces_;  // of the displacement gradient, by layer and field
};

/// The column of hexagonal layers, `apart` spacings apart, each over the hollows of the next. Particles deviate from
/// their sites along both axes of the layer; the standard deviation is `disorder` times the distance of the sites.
template <class Real>
[[nodiscard]] WallColumn<Real> hexagonal_column(int layers, Real apart, Real disorder) {
  constexpr int samples = 400;
  const Real side = std::sqrt(2 / (std::sqrt(Real(3)) * apart)), rise = side * std::sqrt(Real(0.75));
  const Real by = disorder * std::sqrt(Real(12)) * side, first = std::sqrt(Real(2)), second = std::sqrt(Real(3));
  Real drawn = 0;
  // From -1/2 to 1/2; the fractional parts of quadratic sequences are spread evenly, and independently in pairs.
  const auto off = [&](Real root) { return drawn * drawn * root - std::floor(drawn * drawn * root) - Real(0.5); };
  const auto moved = [&](Real x, Real y, Real z) {
    ++drawn;
    return Vector<Real, 3>(x * side + by * off(first), y * rise + by * off(second), z);
  };
  return WallColumn<Real>(layers, apart, [&](const auto& add) {
    for (int layer = 0; layer < layers; ++layer)
      for (int sample = 0; sample < samples; ++sample) {
        const Vector<Real, 3> own = moved(0, 0, 0);
        add(layer, Real(1) / samples, [&](const auto& bond) {
          for (int other = 0; other < layers; ++other) {
            const Real height = (other + (Real(1) - layers) / 2) * apart, hollow = Real(other % 2 - layer % 2);
            for (int p = -4; p <= 4; ++p)
              for (int q = -3; q <= 3; ++q)
                if (other != layer || p != 0 || q != 0)
                  bond(moved(p + (q + hollow) / 2, q + hollow / 3, (other - layer) * apart) - own, height, other);
          }
        });
      }
  });
}

}  // namespace hmps::inline HMPS_ABI::detail
