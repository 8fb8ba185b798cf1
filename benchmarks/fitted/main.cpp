// SPDX-License-Identifier: MIT
// How thin walls of fitted particles bend and twist at any orientation. See --help.
#include <algorithm>
#include <string>
#include <vector>

#include "fitted/scene.hpp"
#include "report/study.hpp"

int main(int argc, char** argv) {
  report::Study study("fitted", "How thin walls of fitted particles bend and twist, whichever way they lie",
                      "the coarsest spacing of each in few placements");
  std::vector<double> spacings{2.4, 1.8, 1.6, 1.2};
  std::vector<std::string> chosen;
  study.app.add_option("spacings", spacings, "of the plates, in mm")->capture_default_str();
  study.app.add_option("--only", chosen, "tables to make anew")
      ->type_name("NAME")
      ->check(CLI::IsMember({"plate", "any", "ring", "bar", "bend", "half-cylinder", "half-ball", "strip", "wide-strip",
                             "wedge", "junction", "leaf", "stress", "edges"}));
  return study.run(argc, argv, [&] {
    if (study.quick) spacings = {2.4};
    for (double& spacing : spacings) spacing *= 1e-3;
    const auto wanted = [&](const std::string& name) {
      return chosen.empty() || std::find(chosen.begin(), chosen.end(), name) != chosen.end();
    };
    if (wanted("plate")) study.publish(fitted::plate_about_one_axis(spacings, study.quick));
    if (wanted("any")) study.publish(fitted::plate_about_any_axis(spacings, study.quick));
    if (wanted("ring")) study.publish(compared(fitted::ring(), study.quick));
    if (wanted("bar")) study.publish(fitted::twisted_bar(study.quick));
    if (wanted("bend")) study.publish(fitted::bent_strip(study.quick));
    if (wanted("stress")) study.publish(fitted::outer_stress(study.quick));
    if (wanted("half-cylinder")) study.publish(compared(fitted::half_cylinder(), study.quick));
    if (wanted("half-ball")) study.publish(compared(fitted::half_ball(), study.quick));
    // Not in a quick run, which is a test: the strips miss their bounds (see the page), or take minutes.
    for (const bool own_volumes : {false, true})
      if (wanted("strip") && !study.quick) study.publish(compared(fitted::strip(own_volumes), false));
    if (wanted("wide-strip") && !study.quick) study.publish(compared(fitted::wide_strip(), false));
    if (wanted("leaf") && !study.quick) study.publish(compared(fitted::leaf(), false));
    if (wanted("wedge")) study.publish(compared(fitted::wedge(), study.quick));
    if (wanted("junction")) study.publish(compared(fitted::junction(), study.quick));
    if (wanted("edges"))
      study.publish(study.quick ? fitted::compared_at_edges({fitted::junction()}, true)
                                : fitted::compared_at_edges(
                                      {fitted::strip(false), fitted::wide_strip(), fitted::wedge(), fitted::junction(),
                                       fitted::half_cylinder(), fitted::half_ball(), fitted::ring(), fitted::leaf()},
                                      false));
  });
}
