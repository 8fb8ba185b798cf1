// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

/// Contact evaluated literally: each slave against every master, equation by equation, with Eigen and without hmps. The
/// tests compare the fast evaluation with it.
namespace plain {

using Vec = Eigen::Vector3d;
using Mat = Eigen::Matrix3d;

struct Contact {
  struct Side {
    std::vector<std::size_t> slaves, masters;
  };
  double l0, density, stiffness, friction, dt;
  double radius;  ///< r_e / l0
  int power;      ///< c = (1 - (r / r_e)^2)^power: 1 as printed in (26), 3 for the smooth metaball
  bool corrected;
  std::vector<Side> sides;  ///< both roles of each pair, (43)
  std::function<double(std::size_t)> slave_radius = [this](std::size_t) { return l0 / 2; };  ///< r_0

  /// Z(y), (27), of the lattice that fills y <= 0: the sum over a layer is an integral over its plane.
  [[nodiscard]] double wall(double y) const {
    double sum = 0;
    for (double h = y / l0; h < radius; h += 1)
      if (h > -radius)
        sum +=
            3.14159265358979323846 * radius * radius * std::pow(1 - h * h / (radius * radius), power + 1) / (power + 1);
    return sum;
  }
  /// Z^-1, (29), by bisection above the outermost layer.
  [[nodiscard]] double distance(double sum) const {
    double low = -0.2 * l0, high = radius * l0;
    for (int k = 0; k < 60; ++k) (wall((low + high) / 2) > sum ? low : high) = (low + high) / 2;
    return low;
  }

  struct Result {
    std::vector<Vec> f;
    std::size_t contacts = 0, sticking = 0;
  };
  [[nodiscard]] Result operator()(const std::vector<Vec>& x, const std::vector<Vec>& v,
                                  const std::vector<Mat>& F) const {
    struct Touch {
      std::size_t slave;
      std::vector<double> share;  // c_ij / C_i of every particle
      Vec n, slip;
      double p;
    };
    std::vector<Touch> touches;
    std::vector<double> acted(x.size(), 0.);
    for (const Side& side : sides)
      for (const std::size_t i : side.slaves) {
        Touch t{i, std::vector<double>(x.size(), 0.), Vec::Zero(), Vec::Zero(), 0};
        double C = 0;
        Vec gradient = Vec::Zero(), velocity = Vec::Zero();
        Mat inverse = Mat::Zero();
        for (const std::size_t j : side.masters) {
          const Mat B = F[j].inverse();
          const Vec r = B * (x[j] - x[i]);
          const double u = 1 - r.squaredNorm() / std::pow(radius * l0, 2);
          if (u <= 0) continue;
          t.share[j] = std::pow(u, power);                                                                // (26)
          C += t.share[j];                                                                                // (28)
          gradient += power * std::pow(u, power - 1) * 2 / std::pow(radius * l0, 2) * B.transpose() * r;  // of (30)
          velocity += t.share[j] * v[j];
          inverse += t.share[j] * B;
        }
        if (C == 0) continue;
        t.n = -gradient.normalized();                                                     // (30)
        t.slip = velocity / C - v[i];                                                     // (31)
        const double stretch = 1 / (inverse / C * t.n).norm();                            // (32, 33)
        const double surface = stretch * (distance(C) - l0 / 2);                          // (34, 35, 36)
        const Vec end = -slave_radius(i) * F[i] * (F[i].transpose() * t.n).normalized();  // (37)
        t.p = -end.dot(t.n) - surface;                                                    // (38)
        if (t.p <= 0) continue;
        acted[i] += 1;
        for (double& share : t.share) share /= C;
        for (std::size_t j = 0; j < x.size(); ++j) acted[j] += t.share[j];
        touches.push_back(t);
      }
    Result result{std::vector<Vec>(x.size(), Vec::Zero()), touches.size(), 0};
    for (const Touch& t : touches) {
      double load = acted[t.slave];
      for (std::size_t j = 0; j < x.size(); ++j) load += t.share[j] * acted[j];
      const Vec normal = stiffness * t.p * t.n;         // (22, 39)
      const Vec slip = t.slip - t.slip.dot(t.n) * t.n;  // (24)
      const double stick = density / dt * slip.norm() / (corrected ? load : 1), slide = friction * normal.norm();
      const Vec f = normal + std::min(stick, slide) * slip.normalized();  // (23, 40)
      result.sticking += stick <= slide;
      result.f[t.slave] += f;
      for (std::size_t j = 0; j < x.size(); ++j) result.f[j] -= t.share[j] * f;  // (41, 42, 43)
    }
    return result;
  }
};

}  // namespace plain
