// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/LU>
#include <cstddef>
#include <vector>

#include "hmps/core/view.hpp"
#include "hmps/laws/law.hpp"
#include "hmps/search/fixed_radius.hpp"

namespace bench {

/// The internal force as one would write it without a library: bonds in compressed rows, small Eigen vectors, and two
/// loops that treat one particle and one neighbour at a time. The algebra is that of the two sweeps and the law is the
/// library's, so the ratio of the times shows only the effect of memory layout and vector units.
template <class S>
class Reference {
 public:
  using Vec = Eigen::Matrix<S, 3, 1>;
  using Mat = Eigen::Matrix<S, 3, 3>;

  Reference(const std::vector<Vec>& reference, S radius)
      : list_(hmps::find_neighbours(hmps::vectors(reference), radius)), coupling_(list_.size()), c_(list_.size()) {
    for (std::size_t i = 0; i < list_.size(); ++i) {
      Mat A = Mat::Zero();
      S n = 0;
      for (const hmps::Index j : list_[i]) {
        const Vec r0 = reference[j] - reference[i];
        const S w = radius / r0.norm() - S(1);  // (8)
        bonds_.push_back({r0, w});
        A += w * r0 * r0.transpose();  // (12)
        n += w;
      }
      inverse_.push_back(A.inverse());
      trace_.push_back(A.trace());
      if (n > n0_) {
        n0_ = n;
        lambda_ = A.trace() / n;
      }
    }
  }

  /// (13), (19) and (21) into `f`.
  template <class Law>
  void operator()(const Law& law, S modulus, S rho, S nu, const std::vector<Vec>& x, const std::vector<Vec>& v,
                  std::vector<Vec>& f) {
    for (std::size_t i = 0; i < list_.size(); ++i) {
      Mat sum = Mat::Zero();
      const Bond* bond = &bonds_[list_.offset[i]];
      for (const hmps::Index j : list_[i]) {
        sum += bond->w * (x[j] - x[i]) * bond->r0.transpose();
        ++bond;
      }
      const Mat F = sum * inverse_[i];     // (11)
      c_[i] = modulus * S(3) / trace_[i];  // (20)
      coupling_[i] = hmps::first_piola_kirchhoff<Law, S, 3>(law, F) * inverse_[i] - c_[i] * F;
    }
    const S d = rho * nu * S(6) / (lambda_ * n0_);
    for (std::size_t i = 0; i < list_.size(); ++i) {
      Vec sum = Vec::Zero();
      const Bond* bond = &bonds_[list_.offset[i]];
      for (const hmps::Index j : list_[i]) {
        sum +=
            bond->w * ((coupling_[i] + coupling_[j]) * bond->r0 + (c_[i] + c_[j]) * (x[j] - x[i]) + d * (v[j] - v[i]));
        ++bond;
      }
      f[i] = sum;
    }
  }

 private:
  struct Bond {
    Vec r0;
    S w;
  };

  hmps::NeighbourList list_;
  std::vector<Bond> bonds_;
  std::vector<Mat> inverse_, coupling_;
  std::vector<S> trace_, c_;
  S n0_ = 0, lambda_ = 0;  // of the particle with the largest sum of weights
};

}  // namespace bench
