// SPDX-License-Identifier: MIT
#pragma once

#include <hmps/laws/mooney_rivlin.hpp>
#include <vector>

#include "scene/organs.hpp"

namespace swallowing {

/// The materials of sections 2.4 to 2.6, 3.7 and 3.8 of the paper.
struct Materials {
  double young = 20e3;                ///< Pa, soft tissue at zero strain
  double young_epiglottis = 100e3;    ///< Pa
  double d1 = 1e6;                    ///< Pa, D1 of \paper{15}
  double density = 1000;              ///< kg/m3
  double kinematic_viscosity = 2e-3;  ///< m2/s, nu of \paper{21}
  double stabiliser_ratio = 1;        ///< E_hat over Young's modulus
  /// Pressure per penetration in N/m3: k of \paper{22} times the spacing. It belongs to the scene and does not depend
  /// on the step or the spacing. The paper's k~ = 0.3 (--penalty-ratio) is stiffer, the more so the smaller the step,
  /// and makes contact chatter.
  double contact_stiffness = 2e8;
  double speed_limit = 20;  ///< m/s: half the speed of sound; nothing in a swallow is as fast

  /// The same with Young's moduli `factor` times as large.
  [[nodiscard]] Materials stiffened(double factor) const {
    Materials materials = *this;
    materials.young *= factor;
    materials.young_epiglottis *= factor;
    return materials;
  }
  [[nodiscard]] double young_of(Organ organ) const { return organ == Organ::epiglottis ? young_epiglottis : young; }
  /// The law of an organ: C1 = C2 from Young's modulus by \paper{18}.
  [[nodiscard]] hmps::MooneyRivlin<double> law(Organ organ) const {
    return hmps::MooneyRivlin<double>::from_young(young_of(organ), d1);
  }
};

}  // namespace swallowing
