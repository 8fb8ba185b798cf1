// SPDX-License-Identifier: MIT
// What the two translation units of the test pass to each other.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/bond_settings.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/lanes/lanes.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/viscous.hpp"

/// A user's particle: a size that Eigen never aligns, and our types.
struct Particle {
  Eigen::Vector3d position;
  hmps::Vector<double, 3> velocity;
  hmps::Matrix<double, 3> gradient;
  float density;
};

/// Sizes and offsets as a translation unit sees them. Behind each `char` stands what Eigen would align
/// to the vector unit if our types let it: 4 numbers, 2 x 2 numbers, lanes.
struct Layout {
  template <class T>
  struct Behind {
    char offset;
    T value;
  };
  std::size_t particle = sizeof(Particle);
  std::size_t vector = sizeof(Behind<hmps::Vector<double, 4>>);
  std::size_t matrix = sizeof(Behind<hmps::Matrix<double, 2>>);
  std::size_t float_matrix = sizeof(Behind<hmps::Matrix<float, 2>>);
  std::size_t lanes = sizeof(Behind<hmps::Matrix<hmps::Lanes<float>, 3>>);
  std::size_t view = sizeof(hmps::VectorView<double, 3>);
  std::size_t bonds = sizeof(hmps::LatticeBonds<double, 3>);
  std::size_t list = sizeof(hmps::BondList<float, 2>);
  friend bool operator==(const Layout&, const Layout&) = default;
};

/// A block of tissue with its bonds and its force, handed from one translation unit to the other.
template <class K, template <class, int> class BondsOf>
struct Body {
  using Bonds = BondsOf<K, 3>;
  using Force = decltype(hmps::internal_force(std::declval<const Bonds&>(), hmps::elastic(hmps::MooneyRivlin<double>{}),
                                              hmps::artificial(1.0), hmps::viscous(1.0, 1.0)));
  std::unique_ptr<Bonds> bonds;
  std::unique_ptr<Force> force;

  explicit Body(std::vector<Particle>& particles) {
    const auto x = hmps::vectors(particles, &Particle::position);
    bonds = std::make_unique<Bonds>(x, hmps::BondSettings{.spacing = 1e-3});
    force = std::make_unique<Force>(*bonds, hmps::elastic(hmps::MooneyRivlin<double>::from_young(2e4, 1e6)),
                                    hmps::artificial(2e4), hmps::viscous(1000, 2e-3));
  }
  void evaluate(std::vector<Particle>& particles, std::vector<hmps::Vector<double, 3>>& f) {
    (*force)(hmps::vectors(particles, &Particle::position), hmps::vectors(particles, &Particle::velocity),
             hmps::vectors(f));
  }
};

inline std::vector<Particle> make_particles() {
  std::vector<Particle> particles;
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < 7; ++z) {
        Particle& p = particles.emplace_back();
        p.position = 1e-3 * Eigen::Vector3d(x, y, z);
        p.velocity.setZero();
        p.gradient.setIdentity();
        p.density = 1000;
      }
  return particles;
}

inline void deform(std::vector<Particle>& particles) {
  for (Particle& p : particles) {
    const Eigen::Vector3d x = p.position;
    p.position += 0.05 * Eigen::Vector3d(x.y(), 0.3 * x.x() - x.z(), std::sin(300 * x.x()) * 1e-3);
    p.velocity = Eigen::Vector3d(std::cos(500 * x.z()), 10 * x.y(), 0);
  }
}

using Lattice = Body<double, hmps::LatticeBonds>;
using FloatLattice = Body<float, hmps::LatticeBonds>;
using Cloud = Body<double, hmps::BondList>;

Layout wide_layout();
std::vector<Particle> wide_particles();
template <class B>
B wide_body(std::vector<Particle>& particles);
template <class B>
void wide_evaluate(B& body, std::vector<Particle>& particles, std::vector<hmps::Vector<double, 3>>& f);
double wide_sum(const hmps::VectorView<const double, 3>& positions, const hmps::MatrixView<const double, 3>& gradients);
hmps::Vector<double, 3> wide_product(hmps::Matrix<double, 3> A, hmps::Vector<double, 3> b);
hmps::Lanes<float> wide_lanes(const hmps::Lanes<float>& a, const hmps::Lanes<float>& b);
