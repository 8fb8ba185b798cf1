// SPDX-License-Identifier: MIT
// The parts of a scene and what they gather for contact, by plain loops over all pairs of particles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <vector>

#include "../../../examples/across_machines/count.hpp"
#include "../../../examples/across_machines/meeting.hpp"
#include "../../../examples/across_machines/page.hpp"
#include "../../../examples/across_machines/partition.hpp"

namespace parts_test {

using namespace across_machines;

bool bonded(const Scene& scene, std::size_t i, std::size_t j) {
  int most = 0;
  for (std::size_t d = 0; d < 3; ++d) most = std::max(most, std::abs(scene.cell(i)[d] - scene.cell(j)[d]));
  return most == 1 && scene.body(i) == scene.body(j);
}

TEST(Parts, HaveEveryParticleOnceAndTwoLayersOfNeighbours) {
  const Scene scene(1300);
  for (const int parts : {1, 2, 5}) {
    const std::vector<int> part_of = CubeGraph(scene, 1).divide(parts);
    const auto own = own_particles(part_of, parts);
    Cutter cutter(scene);
    std::size_t sum = 0;
    for (int p = 0; p < parts; ++p) {
      const Part part = cutter.cut(own[static_cast<std::size_t>(p)]);
      sum += part.own;
      std::vector<int> layer(scene.size(), 3);
      for (std::size_t i = 0; i < layer.size(); ++i)
        if (part_of[i] == p) layer[i] = 0;
      for (const int next : {1, 2})
        for (std::size_t i = 0; i < layer.size(); ++i)
          for (std::size_t j = 0; layer[i] == 3 && j < layer.size(); ++j)
            if (layer[j] == next - 1 && bonded(scene, i, j)) layer[i] = next;
      std::vector<Index> expected;
      for (const int l : {0, 1, 2})
        for (std::size_t i = 0; i < layer.size(); ++i)
          if (layer[i] == l) expected.push_back(static_cast<Index>(i));
      EXPECT_EQ(part.particles, expected);
      for (std::size_t k = 0; k < part.own; ++k) EXPECT_EQ(part.place_of(part.particles[k]), k);
      EXPECT_EQ(part.held,
                static_cast<std::size_t>(std::count_if(layer.begin(), layer.end(), [](int l) { return l < 2; })));
    }
    EXPECT_EQ(sum, scene.size());
  }
}

TEST(Parts, AreBalanced) {
  const Scene scene(20000);
  for (const int edge : {1, 2})
    for (const auto& own : own_particles(CubeGraph(scene, edge).divide(16), 16))
      EXPECT_LT(static_cast<double>(own.size()), 1.1 * static_cast<double>(scene.size()) / 16);
}

TEST(Parts, FollowTheWeightOfContact) {
  const Scene scene(2500);
  EXPECT_EQ(CubeGraph(scene, 1).divide(4), CubeGraph(scene, 1, CubeGraph::usual_contact_weight).divide(4));
  EXPECT_NE(CubeGraph(scene, 1, 0).divide(4), CubeGraph(scene, 1).divide(4));
}

TEST(Parts, WithoutParticlesAreAnError) {
  try {
    (void)own_particles({0, 0, 2, 2}, 3);
    FAIL();
  } catch (const hmps::InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "hmps: part 1 of 3 has no particles, of 4 in all; use fewer ranks, or more particles");
  }
  EXPECT_THROW((void)CubeGraph(Scene(1300), 4).divide(1000), hmps::InputError);
}

// What is reached in h steps from body to body, by sets.
TEST(Meeting, GathersAllParticlesThatAffectTheOwnForces) {
  const Scene scene(1300);
  const auto surface = scene.surface();
  std::vector<hmps::Vector<double, 3>> place;
  for (const SurfaceParticle& s : surface) place.push_back(scene.reference(s.particle));
  const double reach = 1.5 * l0;
  const auto own = [&](std::size_t k) { return scene.cell(surface[k].particle)[0] < 5; };
  const auto partners = [&](std::size_t k) {
    std::set<std::size_t> found;
    for (std::size_t q = 0; q < surface.size(); ++q)
      if (surface[q].body != surface[k].body && (place[q] - place[k]).norm() <= reach) found.insert(q);
    return found;
  };
  std::vector<int> hop(surface.size(), 99);
  for (std::size_t k = 0; k < surface.size(); ++k)
    if (own(k) && !partners(k).empty()) hop[k] = 0;
  for (int h = 1; h <= hops; ++h)
    for (std::size_t k = 0; k < surface.size(); ++k)
      if (hop[k] == h - 1)
        for (const std::size_t q : partners(k)) hop[q] = std::min(hop[q], h);
  const auto gathered = what_meets(surface, place, reach, own);
  std::size_t next = 0, foreign = 0;
  for (std::size_t k = 0; k < surface.size(); ++k) {
    if (hop[k] > hops) continue;
    ASSERT_LT(next, gathered.size());
    EXPECT_EQ(gathered[next].entry, k);
    EXPECT_EQ(gathered[next].slave, surface[k].slave && hop[k] < hops);
    foreign += own(k) ? 0 : 1;
    ++next;
  }
  EXPECT_EQ(next, gathered.size());
  EXPECT_GT(foreign, 0u);
  EXPECT_LT(next, surface.size() / 2);
  EXPECT_TRUE(
      what_meets(surface, place, reach, [&](std::size_t k) { return scene.prescribed(surface[k].particle); }).empty());
}

// One part sends nothing; two halves of a scene send what lies on both sides of the cut.
TEST(Counting, SumsTheParticlesThatPartsBorrow) {
  const Scene scene(2500);
  const auto surface = scene.surface();
  std::vector<hmps::Vector<double, 3>> place;
  for (const SurfaceParticle& s : surface) place.push_back(scene.reference(s.particle));
  CubeGraph graph(scene, 1);
  const Count one = count(scene, graph, surface, place, 1);
  EXPECT_EQ(one.all_bytes, 0);
  EXPECT_EQ(one.own, scene.size());
  const Count two = count(scene, graph, surface, place, 2);
  double bytes = 0;
  const auto part_of = graph.divide(2);
  const auto own = own_particles(part_of, 2);
  for (const auto& particles : own) {
    const Part part = Cutter(scene).cut(particles);
    bytes +=
        48. * static_cast<double>(part.held - part.own) + 24. * static_cast<double>(part.particles.size() - part.held);
  }
  EXPECT_GT(bytes, 0);
  EXPECT_GE(two.all_bytes, bytes);
  EXPECT_EQ(std::fmod(two.all_bytes - bytes, 84), 0) << "the rest is contact";
  EXPECT_LE(two.peers, 1u);
}

// Two machines are twice as fast as one with 4000 particles, and 4/3 times with 1000.
TEST(Page, StatesTheRequiredNumberOfParticles) {
  const Network network{"", 0, 1};
  const Rates rates{1, 1, 1};
  const auto row = [](std::size_t particles, std::size_t largest) {
    return std::vector<Count>{{particles, 1, particles}, {particles, 2, largest}};
  };
  const std::vector<std::vector<Count>> all{row(4000, 2000), row(1000, 750)};
  const auto text = [&](std::size_t doublings, double gain) {
    return needed(stay_below(all, rates, network, doublings, gain));
  };
  EXPECT_EQ(text(1, 5. / 3), "2 k") << "in the middle of their logarithms";
  EXPECT_EQ(text(1, 1.3), "fewer than counted");
  EXPECT_EQ(text(1, 2.1), "more than counted");
  EXPECT_EQ(text(2, 1.3), "not counted in so many parts");
}
TEST(Page, OmitsTheSourceOfOtherRates) {
  const std::vector<std::vector<Count>> all{{{1000, 1, 1000}}};
  const char* source = "docs/measured/benchmarks.md";
  EXPECT_NE(page_of(all, {}, 3).find(source), std::string::npos);
  EXPECT_EQ(page_of(all, {.force = 21}, 3).find(source), std::string::npos);
}

}  // namespace parts_test
