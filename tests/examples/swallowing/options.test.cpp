// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

namespace options_test {

using swallowing::Options;

struct Parsed {
  std::optional<Options> options;
  int exit_code = 0;
  std::string out, err;
};

Parsed parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "swallowing");
  Parsed parsed;
  std::ostringstream out, err;
  parsed.options =
      swallowing::parse_options(static_cast<int>(arguments.size()), arguments.data(), out, err, parsed.exit_code);
  parsed.out = out.str();
  parsed.err = err.str();
  return parsed;
}

TEST(Options, DefaultsAreAllCasesAtTheDefaultSpacing) {
  const auto parsed = parse({});
  ASSERT_TRUE(parsed.options) << parsed.err;
  EXPECT_EQ(parsed.options->cases, (std::vector<std::string>{"X1", "X3", "Y1", "Y3"}));
  EXPECT_EQ(parsed.options->spacing, 2.4e-3);
  EXPECT_EQ(parsed.options->time_step, 0);
  EXPECT_EQ(parsed.options->until, 2.05);
  EXPECT_TRUE(parsed.options->single_precision);
  EXPECT_FALSE(parsed.options->friction);
  EXPECT_TRUE(parsed.options->frames);
  EXPECT_TRUE(parsed.options->surfaces);
  EXPECT_TRUE(parsed.options->constrictors);
  EXPECT_FALSE(parsed.options->resume);
  EXPECT_GE(parsed.options->threads, 1);
}

TEST(Options, QualityNamesSpacingStepAndScalar) {
  double finer = 1;
  for (const swallowing::Quality& quality : swallowing::qualities) {
    const std::string name(quality.name);
    const auto parsed = parse({"--quality", name.c_str()});
    ASSERT_TRUE(parsed.options) << parsed.err;
    const Options& o = *parsed.options;
    EXPECT_EQ((swallowing::Quality{quality.name, o.spacing, o.time_step, o.single_precision}), quality);
    EXPECT_LT(o.spacing, finer);
    finer = o.spacing;
  }
  const auto overruled = parse({"--scalar", "double", "--quality", "paper", "--spacing", "1.8e-3"});
  ASSERT_TRUE(overruled.options) << overruled.err;
  EXPECT_FALSE(overruled.options->single_precision);
  EXPECT_EQ(overruled.options->spacing, 1.8e-3);
  EXPECT_EQ(overruled.options->time_step, 0) << "the step of another spacing was taken";
  EXPECT_EQ(parse({"--quality", "paper", "--time-step", "0"}).options->time_step, 0);
  EXPECT_NE(parse({"--quality", "best"}).err.find("{draft,standard,paper,fine}"), std::string::npos);
}

TEST(Options, EveryOptionIsApplied) {
  const auto parsed = parse({"--case",    "Y3",   "--spacing",       "1.2e-3", "--time-step", "1e-5",
                             "--until",   "1.75", "--friction",      "0.2",    "--scalar",    "float",
                             "--threads", "3",    "--out",           "here",   "--resume",    "--no-frames",
                             "--penalty", "9e11", "--lattice-shift", "0.5",    "--without-H", "--frame-interval",
                             "0.02"});
  ASSERT_TRUE(parsed.options) << parsed.err;
  EXPECT_EQ(parsed.options->cases, std::vector<std::string>{"Y3"});
  EXPECT_EQ(parsed.options->spacing, 1.2e-3);
  EXPECT_EQ(parsed.options->time_step, 1e-5);
  EXPECT_EQ(parsed.options->until, 1.75);
  EXPECT_EQ(parsed.options->friction, 0.2);
  EXPECT_TRUE(parsed.options->single_precision);
  EXPECT_EQ(parsed.options->threads, 3);
  EXPECT_EQ(parsed.options->out, "here");
  EXPECT_TRUE(parsed.options->resume);
  EXPECT_FALSE(parsed.options->frames);
  EXPECT_EQ(parsed.options->penalty, 9e11);
  EXPECT_EQ(parsed.options->lattice_shift, 0.5);
  EXPECT_FALSE(parsed.options->constrictors);
  EXPECT_EQ(parsed.options->frame_interval, 0.02);
  EXPECT_TRUE(parsed.options->surfaces);
  EXPECT_FALSE(parse({"--no-surfaces"}).options->surfaces);
  EXPECT_EQ(parse({"--penalty-ratio", "0.1"}).options->penalty_ratio, 0.1);
  EXPECT_EQ(parse({"--step-share", "0.4"}).options->step_share, 0.4);
  EXPECT_EQ(parse({}).options->stiffness, 1);
  EXPECT_EQ(parse({"--stiffness", "0.8"}).options->stiffness, 0.8);
}

TEST(Options, CasesAreRunInTheirOrderEachOnce) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(parse({"--case", "Y1", "X1"}).options->cases, (Names{"X1", "Y1"}));
  EXPECT_EQ(parse({"--case", "Y1", "--case", "X3", "--case", "Y1"}).options->cases, (Names{"X3", "Y1"}));
  EXPECT_EQ(parse({"--case", "X1", "all"}).options->cases, (Names{"X1", "X3", "Y1", "Y3"}));
  EXPECT_FALSE(parse({"--case", "X1", "Z9"}).options);
}

TEST(Options, TheContactOfThePaperHasItsPenalty) {
  EXPECT_FALSE(parse({}).options->paper_contact);
  EXPECT_FALSE(parse({"--contact", "smooth"}).options->penalty_ratio);
  EXPECT_TRUE(parse({"--contact", "paper"}).options->paper_contact);
  EXPECT_EQ(parse({"--contact", "paper"}).options->penalty_ratio, 0.3);
  EXPECT_EQ(parse({"--contact", "paper", "--penalty-ratio", "0.1"}).options->penalty_ratio, 0.1);
  EXPECT_FALSE(parse({"--contact", "paper", "--penalty", "1e10"}).options->penalty_ratio);
}

TEST(Options, FittedParticlesRejectALatticeShift) {
  EXPECT_FALSE(parse({}).options->fitted);
  EXPECT_FALSE(parse({"--particles", "lattice"}).options->fitted);
  EXPECT_TRUE(parse({"--particles", "fitted"}).options->fitted);
  const auto shifted = parse({"--particles", "fitted", "--lattice-shift", "0.5"});
  EXPECT_FALSE(shifted.options);
  EXPECT_EQ(shifted.exit_code, 2);
  EXPECT_NE(shifted.err.find("do not lie on a lattice that could be shifted"), std::string::npos) << shifted.err;
}

TEST(Options, NumbersAreDecimal) {
  EXPECT_EQ(parse({"--threads", "010"}).options->threads, 10);  // eight, to CLI11
  EXPECT_EQ(parse({"--threads", "+2"}).options->threads, 2);
  EXPECT_EQ(parse({"--lattice-shift", "+0.5"}).options->lattice_shift, 0.5);
  EXPECT_EQ(parse({"--lattice-shift", "-.5"}).options->lattice_shift, -0.5);
}

TEST(Options, HelpNamesEveryOptionAndSucceeds) {
  const auto parsed = parse({"--help"});
  EXPECT_FALSE(parsed.options);
  EXPECT_EQ(parsed.exit_code, 0);
  for (const char* name : {"--case", "--spacing", "--time-step", "--until", "--friction", "--scalar", "--threads",
                           "--out", "--resume", "--no-frames", "--no-surfaces", "--help"})
    EXPECT_NE(parsed.out.find(name), std::string::npos) << name;
}

TEST(Options, MistakesEndWithCodeTwoAndNameTheOption) {
  const std::vector<std::vector<const char*>> mistakes{{"--case", "Z9"},
                                                       {"--spacing", "2.4"},
                                                       {"--spacing", "0"},
                                                       {"--spacing", "-1e-3"},
                                                       {"--spacing", "nan"},
                                                       {"--spacing", "big"},
                                                       {"--spacing"},
                                                       {"--time-step", "-1"},
                                                       {"--time-step", "1"},
                                                       {"--until", "0"},
                                                       {"--until", "3"},
                                                       {"--friction", "-0.1"},
                                                       {"--friction", "inf"},
                                                       {"--stiffness", "0"},
                                                       {"--scalar", "half"},
                                                       {"--threads", "0"},
                                                       {"--threads", "two"},
                                                       {"--penalty", "0"},
                                                       {"--penalty-ratio", "-1"},
                                                       {"--penalty-ratio", "1"},
                                                       {"--step-share", "0"},
                                                       {"--step-share", "0.4", "--time-step", "1e-5"},
                                                       {"--unknown"},
                                                       {"--out", ""},
                                                       {"--lattice-shift", "7"},
                                                       {"--particles", "random"},
                                                       {"--frame-interval", "0"},
                                                       {"--data", "/no/where"},
                                                       {"stray"},
                                                       {"--until", "1.5x"},
                                                       {"--spacing", "2.4e-3 mm"},
                                                       {"--until", "0x1"},  // one second, to CLI11
                                                       {"--until", " 1"},
                                                       {"--until", ""},
                                                       {"--spacing", "0x1p-9"},
                                                       {"--time-step", "0x0"},
                                                       {"--friction", "0x0"},
                                                       {"--friction", "1e-400"},
                                                       {"--friction", "1e400"},
                                                       {"--penalty", "0x1"},
                                                       {"--penalty-ratio", "0x0.8"},
                                                       {"--step-share", "0x0.8"},
                                                       {"--lattice-shift", "0x0"},
                                                       {"--lattice-shift", "nan"},
                                                       {"--frame-interval", "0x1"},
                                                       {"--threads", "0x2"},
                                                       {"--threads", "2.0"},
                                                       {"--contact", "rough"},
                                                       {"--threads", "1000"},  // which only wait for each other
                                                       {"--penalty", "1", "--penalty-ratio", "0.3"}};
  for (const auto& mistake : mistakes) {
    const auto parsed = parse(mistake);
    EXPECT_FALSE(parsed.options) << mistake[0];
    EXPECT_EQ(parsed.exit_code, 2) << mistake[0];
    EXPECT_NE(parsed.err.find(mistake[0]), std::string::npos) << mistake[0] << ": " << parsed.err;
  }
}

}  // namespace options_test
