// SPDX-License-Identifier: MIT
#include "hmps/diagnostics/detail/recorded.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../../../reference/message_of.hpp"
#include "hmps/diagnostics/energy.hpp"
#include "hmps/diagnostics/jacobian.hpp"
#include "hmps/diagnostics/monitor.hpp"
#include "hmps/diagnostics/strain.hpp"
#include "hmps/diagnostics/stress.hpp"
#include "hmps/laws/neo_hookean.hpp"

namespace recorded_test {

using Tensor = hmps::Matrix<double, 3>;
using Vector = hmps::Vector<double, 3>;

// A forgotten `record(F)` leaves zeros, which could be taken for a body without volume.
TEST(Recorded, DiagnosticsRefuseGradientsThatNothingHasWritten) {
  std::vector<Tensor> F(5, Tensor::Identity()), out(5);
  std::vector<Vector> x(5, Vector::Zero()), v = x;
  std::vector<double> mises(5);
  const auto law = hmps::NeoHookean<>::from_young_poisson(20e3, 0.4);
  const auto refused = [&](const auto& call) {
    F[3].setIdentity();
    EXPECT_NO_THROW(call());
    F[3].setZero();
    const std::string text = hmps_test::message_of(call);
    EXPECT_NE(text.find("deformation gradient of particle 3 is zero"), std::string::npos) << text;
    EXPECT_NE(text.find("record(F)"), std::string::npos) << text;
  };
  const auto read = hmps::matrices(F);
  refused([&] { (void)hmps::jacobian_statistics(read); });
  refused([&] { hmps::green_lagrange_strains(read, hmps::matrices(out)); });
  refused([&] { hmps::principal_stretches(read, hmps::vectors(v)); });
  refused([&] { hmps::cauchy_stresses(read, law, hmps::matrices(out)); });
  refused([&] { hmps::von_mises_stresses(read, law, hmps::scalars(mises)); });
  refused([&] { (void)hmps::strain_energy(read, law, 1e-9); });
  refused([&] { (void)hmps::check_state(hmps::vectors(x), hmps::vectors(v), read, {}); });
  // A particle that is crushed flat, but whose F was written, is accepted.
  F[3] = Vector(1, 1, 0).asDiagonal();
  EXPECT_NO_THROW(hmps::detail::require_recorded(read));
  EXPECT_EQ(hmps::jacobian_statistics(read).min, 0);
}

}  // namespace recorded_test
