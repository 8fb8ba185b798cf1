// SPDX-License-Identifier: MIT
#include "tradeoff/sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tradeoff/agreement.hpp"
#include "tradeoff/meter.hpp"
#include "tradeoff/page.hpp"
#include "tradeoff/rules.hpp"
#include "tradeoff/table.hpp"

namespace sweep_test {

using namespace tradeoff;

/// A scene that is a formula: the answer 2 is missed by h^2 and by `bias`, at the cost 1 / h; float takes half.
Scene formula() {
  return {.name = "formula",
          .title = "A formula",
          .description = "No simulation.",
          .quantities = {{.name = "the answer"}},
          .parameters = {{.name = "h", .values = {0.4, 0.2, 0.1}, .standard = 0.2, .refines = true},
                         {.name = "bias", .values = {0., -0.16}, .standard = 0.},
                         {.name = "scalar", .values = {"double", "float", "half"}, .standard = "double"}},
          .crossed = {{"h", "bias"}},
          .run =
              [](const Settings& s) {
                if (s.word("scalar") == "half") throw hmps::StateError("overflow");
                const double h = s.number("h");
                return Outcome{{2 + h * h + s.number("bias")}, 1 / h, (s.word("scalar") == "float" ? 0.5 : 1) / h, 100};
              },
          .known = [](const Settings&) { return std::vector<double>{2}; }};
}
Sweep swept(const Scene& scene) {
  return sweep(scene, [](const std::string&) {});
}
std::string message_of(const Scene& scene) {
  try {
    (void)swept(scene);
  } catch (const hmps::InputError& error) {
    return error.what();
  }
  return "";
}
bool holds_text(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Plan, StartsWithTheStandardAndHoldsEveryCombinationOnce) {
  const auto all = plan(formula());
  EXPECT_EQ(all.size(), 3U * 2 + 2);
  EXPECT_EQ(all.front(), formula().standard());
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(all[i], all[j]);
}
/// The groups share h, but bias and scalar are never combined.
TEST(Plan, CrossesParametersWithinEachGroupOnly) {
  Scene scene = formula();
  scene.crossed = {{"h", "bias"}, {"h", "scalar"}};
  const auto all = plan(scene);
  EXPECT_EQ(all.size(), 3U * 2 + 3 * 2);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(all[i], all[j]);
  for (const Settings& settings : all) EXPECT_TRUE(settings.number("bias") == 0 || settings.word("scalar") == "double");
  const auto holds_settings = [&](const Settings& wanted) {
    return std::find(all.begin(), all.end(), wanted) != all.end();
  };
  for (const Value& h : scene.parameter("h").values) {
    EXPECT_TRUE(holds_settings(scene.standard().with("h", h).with("bias", -0.16)));
    for (const char* scalar : {"float", "half"})
      EXPECT_TRUE(holds_settings(scene.standard().with("h", h).with("scalar", scalar)));
  }
}
TEST(Plan, RefusesAGroupWithAParameterThatIsNotThere) {
  Scene scene = formula();
  scene.crossed = {{"h", "bias"}, {"h", "spacing"}};
  EXPECT_THROW((void)plan(scene), hmps::InputError);
}
TEST(Plan, AsksForTheStandardAmongTheValues) {
  Scene scene = formula();
  scene.parameters[0].standard = 0.3;
  EXPECT_TRUE(holds_text(message_of(scene), "standard value of h"));
}

TEST(Sweep, TakesErrorsInPerCentOfTheAnswerAndRatiosToTheStandard) {
  const Scene scene = formula();
  const Sweep result = swept(scene);
  EXPECT_NEAR(result.standard().errors[0], 2, 1e-12);
  const Trial* fine = result.find(scene.standard().with("h", 0.1));
  ASSERT_NE(fine, nullptr);
  EXPECT_NEAR(fine->errors[0], 0.5, 1e-12);
  EXPECT_NEAR(fine->relative_seconds, 2, 1e-12);
  EXPECT_NEAR(result.find(scene.standard().with("scalar", "float"))->relative_seconds, 0.5, 1e-12);
}
TEST(Sweep, ExcludesFailedRunsFromTheFront) {
  const Scene scene = formula();
  const Sweep result = swept(scene);
  const Trial* broken = result.find(scene.standard().with("scalar", "half"));
  ASSERT_NE(broken, nullptr);
  EXPECT_EQ(broken->failure, "overflow");
  for (const Cost& cost : costs)
    for (const Trial* run : front(scene, result, 0, cost)) EXPECT_NE(run, broken);
}
TEST(Sweep, ComparesWithTheReferenceWithoutAnExactAnswer) {
  Scene scene = formula();
  scene.known = nullptr;
  EXPECT_TRUE(holds_text(message_of(scene), "neither known answers nor a reference"));
  scene.reference = scene.standard().with("h", 0.01);
  EXPECT_NEAR(swept(scene).standard().errors[0], 100 * (2.04 / 2.0001 - 1), 1e-9);
}
TEST(Sweep, RefusesValuesThatAreNotFiniteAndNamesThem) {
  Scene scene = formula();
  scene.run = [](const Settings& s) { return Outcome{{s.number("h") < 0.15 ? std::nan("") : 2.}, 1, 1, 1}; };
  const std::string words = message_of(scene);
  EXPECT_TRUE(holds_text(words, "the answer of the scene formula is nan at h 0.1")) << words;
  EXPECT_TRUE(holds_text(words, "throw hmps::StateError")) << words;
}
TEST(Sweep, RefusesARunThatGivesOtherValuesWhenRepeated) {
  Scene scene = formula();
  int calls = 0;
  scene.run = [&calls](const Settings&) { return Outcome{{2.0 + ++calls}, 1, 0.1, 1}; };
  EXPECT_TRUE(holds_text(message_of(scene), "must depend on its settings only"));
}
TEST(Sweep, RefusesAStandardThatFailsAndPerCentOfNothing) {
  Scene scene = formula();
  scene.parameters[2].standard = "half";
  EXPECT_TRUE(holds_text(message_of(scene), "overflow"));
  scene = formula();
  scene.known = [](const Settings&) { return std::vector<double>{0}; };
  EXPECT_TRUE(holds_text(message_of(scene), "give the quantity a scale"));
}
TEST(Sweep, LeavesOtherProblemsOutOfTheFront) {
  Scene scene = formula();
  scene.parameters[1].choice = false;
  const Sweep result = swept(scene);
  for (const Trial* run : front(scene, result, 0, costs[0])) EXPECT_EQ(run->settings.number("bias"), 0);
}

/// With the bias the error is exactly 0 at h = 0.4 and grows when h falls: no advice.
TEST(Rules, DoNotAdviseRunsWhoseErrorOnlyCrossesZero) {
  const Scene scene = formula();
  const Sweep result = swept(scene);
  const Trial* lucky = result.find(scene.standard().with("h", 0.4).with("bias", -0.16));
  ASSERT_NE(lucky, nullptr);
  EXPECT_NEAR(lucky->errors[0], 0, 1e-12);
  EXPECT_EQ(front(scene, result, 0, costs[0]).front(), lucky);
  EXPECT_FALSE(holds(scene, result, *lucky, 0, 1));
  EXPECT_TRUE(holds(scene, result, *lucky, 0, 10));
  EXPECT_TRUE(holds(scene, result, result.standard(), 0, 2.01));
  EXPECT_FALSE(holds(scene, result, result.standard(), 0, 1.99));
}
/// 2 % would be kept by h = 0.2, which h = 0.1 confirms, and sooner by the same in float, which nothing does.
TEST(Rules, PreferARunThatAFinerOneConfirms) {
  const Scene scene = formula();
  const auto sentences = target_rules(scene, swept(scene));
  ASSERT_EQ(sentences.size(), 3U);
  EXPECT_TRUE(holds_text(sentences[0], "%**: h 0.4;")) << sentences[0];
  EXPECT_TRUE(holds_text(sentences[1], "%**: the standard;")) << sentences[1];
  EXPECT_TRUE(holds_text(sentences[2], "%**: h 0.1;")) << sentences[2];
  EXPECT_TRUE(holds_text(sentences[2], "nothing finer")) << sentences[2];
  EXPECT_FALSE(holds_text(sentences[1], "nothing finer")) << sentences[1];
}
TEST(Rules, SayWhatHalvingCosts) {
  const Scene scene = formula();
  const auto sentences = halving_rules(scene, swept(scene));
  ASSERT_EQ(sentences.size(), 2U);
  EXPECT_EQ(sentences[0],
            "Halving the h from 0.4 to 0.2 costs 2 times the particle-steps, 2 times the time and the same memory: the "
            "error of the answer goes from 8 to 2 %.");
}
TEST(Rules, JudgeErrorsAndTimeTogether) {
  const Scene scene = formula();
  const auto run = [&](double error, double seconds) {
    return Trial{scene.standard(), {{2}, 1, 1, 1}, {2}, {error}, seconds, ""};
  };
  const Trial standard = run(-2, 1);
  EXPECT_EQ(judge(scene, run(2, 0.5), standard), Verdict::take);
  EXPECT_EQ(judge(scene, run(1, 1), standard), Verdict::take);
  EXPECT_EQ(judge(scene, run(1, 2), standard), Verdict::buy);
  EXPECT_EQ(judge(scene, run(3, 0.5), standard), Verdict::save);
  EXPECT_EQ(judge(scene, run(-3, 1), standard), Verdict::leave);
  EXPECT_EQ(judge(scene, run(2, 2), standard), Verdict::leave);
  EXPECT_EQ(judge(scene, run(2.05, 1.05), standard), Verdict::same);
}

TEST(Page, HasATableOfEachPairOfCrossedParameters) {
  Scene scene = formula();
  scene.crossed = {{"h", "bias"}, {"h", "bias", "scalar"}};
  const std::string text = section(scene, swept(scene), "x.png");
  EXPECT_TRUE(holds_text(text, "### Combinations of h and bias\n\n| h, bias |")) << text;
  EXPECT_TRUE(holds_text(text, "| 0.1, -0.16 |")) << text;
  EXPECT_EQ(text.find("### Combinations"), text.rfind("### Combinations")) << "three are too many for a table";
}

TEST(Csv, HasALineForEachRunAndQuotesWords) {
  Scene scene = formula();
  const auto run = scene.run;
  scene.run = [run](const Settings& s) {
    if (s.word("scalar") == "half") throw hmps::StateError("a \"bad\", bad end");
    return run(s);
  };
  const std::string text = csv(scene, swept(scene));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 8);
  EXPECT_TRUE(holds_text(text, "\"a \"\"bad\"\", bad end\"\n"));
  EXPECT_TRUE(holds_text(text, "0.1,0,double,2.01,2,"));
}
TEST(Csv, ReadsBackToTheSameSweep) {
  Scene scene = formula();
  const auto run = scene.run;
  scene.run = [run](const Settings& s) {
    if (s.word("scalar") == "half") throw hmps::StateError("a \"bad\",\nbad end");
    return run(s);
  };
  const Sweep before = swept(scene), after = read_csv(scene, csv(scene, before));
  ASSERT_EQ(after.runs.size(), before.runs.size());
  for (std::size_t i = 0; i < before.runs.size(); ++i) {
    const Trial &a = before.runs[i], &b = after.runs[i];
    EXPECT_EQ(a.settings, b.settings);
    EXPECT_EQ(a.failure, b.failure);
    EXPECT_EQ(a.errors, b.errors);
    EXPECT_EQ(a.outcome.values, b.outcome.values);
    EXPECT_EQ(a.outcome.bytes, b.outcome.bytes);
    EXPECT_EQ(a.relative_seconds, b.failed() ? a.relative_seconds : b.relative_seconds);
  }
  EXPECT_EQ(section(scene, after, "x.png"), section(scene, before, "x.png"));
}
TEST(Csv, RefusesTheTableOfAnotherScene) {
  const Scene scene = formula();
  const std::string text = csv(scene, swept(scene));
  Scene other = scene;
  other.parameters.pop_back();
  EXPECT_THROW((void)read_csv(other, text), hmps::InputError);
  other = scene;
  other.parameters[0].standard = 0.4;
  EXPECT_THROW((void)read_csv(other, text), hmps::InputError);
  EXPECT_THROW((void)read_csv(scene, ""), hmps::InputError);
  EXPECT_THROW((void)read_csv(scene, text + "x,0,double,1,1,1,1,1,1,1,\n"), hmps::InputError);
}

TEST(Agreement, ReportsDifferencesAndOmitsSettingsOfASingleScene) {
  Scene one = formula(), other = formula();
  other.name = "other";
  other.parameters[2].values = {"double", "float"};
  other.run = [](const Settings& s) {  // the bias makes it better, float worse
    const double error = 0.4 + s.number("bias") + (s.word("scalar") == "float" ? 1 : 0);
    return Outcome{{2 + error}, 1, s.word("scalar") == "float" ? 0.5 : 1, 1};
  };
  const std::string text = agreement({{one, swept(one)}, {other, swept(other)}});
  const auto after = [&](const char* title, const char* line) {
    const auto from = text.find(title), to = text.find("###", from + 3);
    return from != std::string::npos && holds_text(text.substr(from, to - from), line);
  };
  EXPECT_TRUE(after("### Larger errors",
                    "scalar float instead of double, at 0.5 times the time (other: the answer from 20 to 70 %)"))
      << text;
  EXPECT_TRUE(
      after("### Smaller errors in some cases, larger in others", "bias -0.16 instead of 0, at 1 times the time"))
      << text;
  EXPECT_FALSE(holds_text(text, "half")) << "only one scene tried it";
  const std::string same = agreement({{one, swept(one)}, {one, swept(one)}});
  EXPECT_TRUE(holds_text(same, "### No difference in errors\n\n- scalar float")) << same;
  EXPECT_TRUE(holds_text(same, "### Failures\n\n- scalar half instead of double (formula, formula)")) << same;
}
TEST(Settings, NameMissingAndMistypedSettings) {
  const Settings settings = formula().standard();
  EXPECT_THROW((void)settings.number("spacing"), hmps::InputError);
  EXPECT_THROW((void)settings.number("scalar"), hmps::InputError);
  EXPECT_THROW((void)settings.word("h"), hmps::InputError);
  EXPECT_THROW((void)settings.with("spacing", 1.), hmps::InputError);
}
TEST(Meter, CountsTheMemoryThatIsHeld) {
  Meter meter;
  std::vector<double> kept(1000);
  { const std::vector<double> gone(100000); }
  meter.count(7);
  const Outcome outcome = meter.outcome({});
  EXPECT_GE(outcome.bytes, 8000U);
  EXPECT_LT(outcome.bytes, 8100U);
  EXPECT_EQ(outcome.particle_steps, 7);
  EXPECT_GE(meter.peak(), 808000U);
  EXPECT_LT(meter.peak(), 820000U);
}

}  // namespace sweep_test
