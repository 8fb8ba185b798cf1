// SPDX-License-Identifier: MIT
// Contact with walls of particles at an angle. See --help.
#include <string>
#include <vector>

#include "report/study.hpp"
#include "walls/density.hpp"
#include "walls/inclines.hpp"
#include "walls/layers.hpp"
#include "walls/slides.hpp"

int main(int argc, char** argv) {
  using namespace walls;
  report::Study study(
      "walls",
      "Accuracy of particle walls that are cut out of their lattice at an angle, or fitted to their surface: drag, "
      "ripple, friction",
      "the smooth kernel at 15 degrees, to see that the properties hold");
  return study.run(argc, argv, [&] {
    study.publish(density_table(), {"normal_density.png", "The normal density Z(y)", draw_density});
    std::vector<Found> all;
    if (!study.quick) measure<hmps::PaperMetaball>("paper", Part::wall, study.quick, all);
    measure<hmps::SmoothMetaball>("smooth", Part::wall, study.quick, all);
    if (!study.quick) measure<hmps::SmoothMetaball>("smooth", Part::block, study.quick, all);
    if (!study.quick) measure<hmps::SmoothMetaball>("smooth", Part::both, study.quick, all);
    if (!study.quick) measure<WideMetaball>("wide", Part::wall, study.quick, all);
    study.publish("rules", rules_of(all));
    study.publish(table_of(all),
                  {"walls.png", "Error of friction over the angle", [&](const auto& path) { draw(all, path); }});
    if (!study.quick) study.publish(layers());
    study.publish(friction(study.quick));
    study.publish(limit(study.quick));
  });
}
