// SPDX-License-Identifier: MIT
#include "output/checkpoint.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <random>

#include "../../reference/message_of.hpp"
#include "../../reference/temporary_folder.hpp"

namespace checkpoint_test {

using hmps::InputError;
using hmps_test::message_of;
using hmps_test::TemporaryFolder;
using swallowing::Checkpoint;

Checkpoint example(std::uint64_t step, std::size_t size = 1000) {
  std::mt19937_64 random(step);
  Checkpoint c;
  c.settings = {{"spacing", "0.0024"}, {"case", "X1"}};
  c.time = 1e-5 * static_cast<double>(step);
  c.step = step;
  std::vector<double> x(size);
  std::vector<std::array<float, 3>> v(size);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (auto& value : x) value = uniform(random);
  for (auto& vector : v)
    for (auto& value : vector) value = static_cast<float>(uniform(random));
  c.set("x", x);
  c.set("v", v);
  c.set("seconds", 42.5);
  c.set("none", std::vector<double>());
  return c;
}

TEST(Checkpoint, RestoresEveryBit) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "checkpoint.bin";
  EXPECT_FALSE(Checkpoint::load(path));
  const Checkpoint written = example(77);
  written.save(path);
  const auto read = Checkpoint::load(path);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->time, written.time);
  EXPECT_EQ(read->step, 77u);
  EXPECT_EQ(read->settings, written.settings);
  EXPECT_EQ(read->get<double>("x"), written.get<double>("x"));
  std::vector<std::array<float, 3>> v(1000);
  read->get("v", v);
  EXPECT_EQ(v, (written.get<std::array<float, 3>>("v")));
  EXPECT_EQ(read->value<double>("seconds"), 42.5);
  EXPECT_TRUE(read->get<double>("none").empty());
  EXPECT_TRUE(read->contains("none"));
  EXPECT_FALSE(read->contains("nothing"));
}

/// So that what was written before can be read.
TEST(Checkpoint, KeepsItsBytes) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "checkpoint.bin";
  Checkpoint c;
  c.settings = {{"case", "X1"}};
  c.time = 0.5;
  c.step = 7;
  c.set("a", std::vector<double>{1, 2});
  c.save(path);
  const std::string bytes = examples::read_file(path);
  ASSERT_EQ(bytes.size(), 146U);
  std::uint64_t sum = 0;
  std::memcpy(&sum, bytes.data() + 138, 8);
  EXPECT_EQ(sum, 14623905792426564927U);
}

TEST(Checkpoint, SetTwiceKeepsTheLast) {
  Checkpoint c;
  c.set("a", 1.0);
  c.set("a", 2.0);
  EXPECT_EQ(c.value<double>("a"), 2.0);
}

TEST(Checkpoint, DetectsAnyDamage) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "checkpoint.bin";
  example(3, 40).save(path);
  const std::string whole = examples::read_file(path);
  for (std::size_t at = 0; at < whole.size(); at += 13) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    examples::write_atomically(path, damaged);
    EXPECT_THROW((void)Checkpoint::load(path), InputError) << "byte " << at;
  }
  for (std::size_t length = 0; length < whole.size(); length += 17) {
    examples::write_atomically(path, whole.substr(0, length));
    EXPECT_THROW((void)Checkpoint::load(path), InputError) << "cut at " << length;
  }
}

TEST(Checkpoint, OtherSettingsAreRefusedByName) {
  const Checkpoint c = example(1);
  EXPECT_NO_THROW(swallowing::require_same_settings(c, {{"case", "X1"}, {"spacing", "0.0024"}}, "c.bin", false));
  const auto refusal = [&](const swallowing::RunSettings& settings) {
    return message_of<InputError>([&] { swallowing::require_same_settings(c, settings, "c.bin", false); });
  };
  const std::string spacing = refusal({{"case", "X1"}, {"spacing", "0.0018"}});
  for (const char* part : {"c.bin", "spacing", "0.0024", "0.0018"}) EXPECT_NE(spacing.find(part), std::string::npos);
  EXPECT_NE(refusal({{"case", "X1"}}).find("spacing"), std::string::npos);
  EXPECT_NE(refusal({{"case", "X1"}, {"spacing", "0.0024"}, {"scalar", "float"}}).find("scalar"), std::string::npos);
}

TEST(Checkpoint, TracksMayDifferAfterItsTime) {
  Checkpoint c = example(1);
  c.settings.emplace_back("content of tongue.csv", "17");
  swallowing::RunSettings settings{{"spacing", "0.0024"}, {"case", "X1"}, {"content of tongue.csv", "18"}};
  EXPECT_NO_THROW(swallowing::require_same_settings(c, settings, "c.bin", true));
  const auto refusal = [&](bool same_motion) {
    return message_of<InputError>([&] { swallowing::require_same_settings(c, settings, "c.bin", same_motion); });
  };
  EXPECT_NE(refusal(false).find("content of tongue.csv 17 in place of 18"), std::string::npos) << refusal(false);
  settings[0].second = "0.0018";
  EXPECT_NE(refusal(true).find("spacing"), std::string::npos) << "other settings are still compared";
}

TEST(Checkpoint, WrongNamesSizesAndTypesAreRefused) {
  const Checkpoint c = example(1, 5);
  EXPECT_THROW((void)c.get<double>("y"), InputError);
  EXPECT_THROW((void)c.get<float>("x"), InputError);
  std::vector<double> six(6);
  EXPECT_THROW(c.get("x", six), InputError);
  EXPECT_THROW((void)c.value<double>("x"), InputError);
}

// A child writes checkpoints one after another and is killed in the midst: what is there is whole.
TEST(Checkpoint, SurvivesAKillAtAnyMoment) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "checkpoint.bin";
  for (int round = 0; round < 10; ++round) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (std::uint64_t step = 1;; ++step) example(step, 20000).save(path);
    }
    while (!std::filesystem::exists(path)) ::usleep(500);
    ::usleep(static_cast<useconds_t>(3000 + 1700 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const auto read = Checkpoint::load(path);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->get<double>("x"), example(read->step, 20000).get<double>("x"));
  }
}

}  // namespace checkpoint_test
