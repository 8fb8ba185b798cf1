// SPDX-License-Identifier: MIT
#include "output/pictures.hpp"

#include <cairo.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "../../reference/message_of.hpp"
#include "../../reference/temporary_folder.hpp"
#include "output/carried_organs.hpp"
#include "output/checkpoint.hpp"
#include "output/comparison.hpp"
#include "output/labels.hpp"
#include "output/model.hpp"
#include "output/observe.hpp"
#include "output/panels.hpp"
#include "scene/build_scene.hpp"

namespace pictures_test {

using hmps_test::TemporaryFolder;
using swallowing::Role;
using swallowing::Snapshot;
using swallowing::Snapshots;

/// A block of one organ, 40 mm by 20 mm by 60 mm, with a dark layer below and a grey one behind.
Snapshot block(double time) {
  Snapshot s;
  s.time = time;
  s.spacing = 2e-3;
  s.organs = {"tongue", "epiglottis"};
  s.regions = {"A", "H"};
  for (int i = 0; i < 20; ++i)
    for (int j = -5; j < 5; ++j)
      for (int k = 0; k < 30; ++k) {
        s.positions.push_back(
            {2e-3f * static_cast<float>(i), 2e-3f * (static_cast<float>(j) + 0.5f), 2e-3f * static_cast<float>(k)});
        s.organ.push_back(k > 20 ? 1 : 0);
        s.role.push_back(k == 0 ? Role::control : i == 19 ? Role::plate : Role::free);
        s.region.push_back(k == 0 ? 0 : i == 19 ? 1 : Snapshot::no_region);
      }
  s.centre = {0.01, 0, 0.045};
  s.tip = {0.02, 0, 0.055};
  s.tip_angle = 45;
  return s;
}

struct Png {
  cairo_surface_t* surface;
  explicit Png(const std::filesystem::path& path) : surface(cairo_image_surface_create_from_png(path.c_str())) {}
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;
  ~Png() { cairo_surface_destroy(surface); }
  /// The share of pixels that `wanted(red, green, blue)` holds for, of the whole picture or of a part.
  template <class Wanted>
  [[nodiscard]] double share(Wanted&& wanted) const {
    return share(wanted, 0, 0, cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface));
  }
  template <class Wanted>
  [[nodiscard]] double share(Wanted&& wanted, int left, int top, int width, int height) const {
    const unsigned char* data = cairo_image_surface_get_data(surface);
    int count = 0;
    for (int y = top; y < top + height; ++y)
      for (int x = left; x < left + width; ++x) {
        const unsigned char* p = data + y * cairo_image_surface_get_stride(surface) + 4 * x;
        count += wanted(int{p[2]}, int{p[1]}, int{p[0]});
      }
    return static_cast<double>(count) / width / height;
  }
};

constexpr auto red = [](int r, int g, int b) { return r > 150 && g < 120 && b < 120; };
constexpr auto yellow = [](int r, int g, int b) { return r > 200 && g > 150 && b < 100; };
constexpr auto dark = [](int r, int g, int b) { return r < 70 && g < 70 && b < 80; };

TEST(Pictures, RestoresASnapshot) {
  const TemporaryFolder folder;
  const Snapshots snapshots(folder.path() / "snapshots");
  EXPECT_FALSE(snapshots.load(1.667));
  const Snapshot s = block(1.667);
  snapshots.add(1.667, s);
  const auto read = snapshots.load(1.667);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->time, s.time);
  EXPECT_EQ(read->spacing, s.spacing);
  EXPECT_EQ(read->positions, s.positions);
  EXPECT_EQ(read->organ, s.organ);
  EXPECT_EQ(read->role, s.role);
  EXPECT_EQ(read->region, s.region);
  EXPECT_EQ(read->organs, s.organs);
  EXPECT_EQ(read->regions, s.regions);
  EXPECT_EQ(read->centre, s.centre);
  EXPECT_EQ(read->tip, s.tip);
  EXPECT_EQ(read->tip_angle, 45);
}

TEST(Pictures, ASnapshotWithoutRegionsIsRefused) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "snapshot_0.000s.bin";
  const Snapshots snapshots(folder.path());
  snapshots.add(0, block(0));
  // As it was written before snapshots knew the regions.
  const auto whole = swallowing::Checkpoint::load(file);
  swallowing::Checkpoint old;
  old.settings = {{"organ", "tongue"}};
  old.set("spacing", whole->value<double>("spacing"));
  old.set("positions", whole->get<std::array<float, 3>>("positions"));
  old.set("organ", whole->get<std::uint8_t>("organ"));
  old.set("role", whole->get<Role>("role"));
  for (const char* name : {"centre", "tip", "tip_angle"}) old.set(name, whole->get<double>(name));
  old.save(file);
  const std::string refusal = hmps_test::message_of([&] { (void)snapshots.load(0); });
  EXPECT_NE(refusal.find("does not hold region; it was written by another version"), std::string::npos) << refusal;
}

TEST(Pictures, AResumedRunKeepsWhatLiesBeforeTheCheckpoint) {
  const TemporaryFolder folder;
  {
    const Snapshots snapshots(folder.path());
    for (const double time : {0., 0.5, 1.383, 1.583, 1.667}) snapshots.add(time, block(time));
  }
  {
    const Snapshots snapshots(folder.path(), 1.4);
    EXPECT_TRUE(snapshots.load(0) && snapshots.load(0.5) && snapshots.load(1.383));
    EXPECT_FALSE(snapshots.load(1.583) || snapshots.load(1.667));
  }
  const Snapshots anew(folder.path());
  EXPECT_FALSE(anew.load(0));
}

TEST(Pictures, TheSheetShowsOrgansAndControlRegions) {
  const TemporaryFolder folder;
  const Snapshots snapshots(folder.path() / "snapshots");
  const auto path = folder.path() / "sheet.png";
  swallowing::draw_sheet(path, snapshots, "nothing yet");
  EXPECT_LT(Png(path).share(red), 1e-3);

  for (const double time : swallowing::snapshot_times) snapshots.add(time, block(time));
  swallowing::draw_sheet(path, snapshots, "all");
  const Png sheet(path);
  ASSERT_EQ(cairo_surface_status(sheet.surface), CAIRO_STATUS_SUCCESS);
  EXPECT_GT(cairo_image_surface_get_width(sheet.surface), 1500);
  EXPECT_GT(sheet.share(red), 0.2);
  EXPECT_GT(sheet.share(yellow), 0.05);
  EXPECT_GT(sheet.share(dark), 0.01);
}

TEST(Pictures, OnlyTheRightHalfIsDrawn) {
  const TemporaryFolder folder;
  const Snapshots snapshots(folder.path() / "snapshots");
  Snapshot s = block(0);
  for (auto& p : s.positions) p[1] = -std::abs(p[1]);
  snapshots.add(0, s);
  swallowing::draw_sheet(folder.path() / "sheet.png", snapshots, "left");
  EXPECT_LT(Png(folder.path() / "sheet.png").share(yellow), 1e-3);
}

/// The letters that are seen from the midsagittal plane, each with its place in mm.
std::vector<std::pair<std::string, std::array<double, 2>>> seen(const Snapshot& s) {
  const auto window = swallowing::Window::of_width(400, -0.004, -0.004, 0.042, 0.064);
  std::vector<std::pair<std::string, std::array<double, 2>>> places;
  for (const auto& label : swallowing::visible_regions(s, swallowing::from_midsagittal_plane(), window))
    places.push_back({label.letter, {1e3 * label.x / window.scale - 4, 64 - 1e3 * label.y / window.scale}});
  return places;
}

TEST(Pictures, RegionsAreLabelledWhereTheyAreSeen) {
  Snapshot s = block(0);
  const auto places = seen(s);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].first, "A");  // the layer below, 0 to 36 mm without the plates' 38
  EXPECT_NEAR(places[0].second[0], 19, 2);
  EXPECT_NEAR(places[0].second[1], 0, 1);
  EXPECT_EQ(places[1].first, "H");  // the layer behind, 2 to 58 mm
  EXPECT_NEAR(places[1].second[0], 38, 1);
  EXPECT_NEAR(places[1].second[1], 30, 2);
  // The particles of the plane hide a region behind them.
  for (std::size_t i = 0; i < s.positions.size(); ++i)
    if (s.positions[i][1] < 2e-3f) s.region[i] = Snapshot::no_region;
  EXPECT_TRUE(seen(s).empty());
}

TEST(Pictures, ARegionInTwoPartsHasTwoLabels) {
  Snapshot s = block(0);
  s.regions = {"D left", "H"};
  for (std::size_t i = 0; i < s.positions.size(); ++i)
    if (s.region[i] == 0 && std::abs(s.positions[i][0] - 10e-3f) < 3e-3f) s.region[i] = Snapshot::no_region;
  const auto places = seen(s);
  ASSERT_EQ(places.size(), 3u);
  EXPECT_EQ(places[0].first, "D") << "without the side";
  EXPECT_EQ(places[1].first, "D");
  EXPECT_LT(places[0].second[0], 6);
  EXPECT_GT(places[1].second[0], 14);
}

/// The body at rest.
Snapshot at_rest(const swallowing::Scene& scene) {
  Snapshot s;
  s.spacing = scene.spacing;
  for (int o = 0; o < swallowing::organ_count; ++o) s.organs.emplace_back(name(static_cast<swallowing::Organ>(o)));
  for (std::size_t i = 0; i < scene.reference.size(); ++i) {
    const Eigen::Vector3f x = scene.reference[i].cast<float>();
    s.positions.push_back({x[0], x[1], x[2]});
    s.organ.push_back(static_cast<std::uint8_t>(scene.organ[i]));
    s.role.push_back(i >= scene.elastic_count ? Role::plate : scene.region[i] >= 0 ? Role::control : Role::free);
  }
  note_regions(s, scene);
  return s;
}

const swallowing::Scene& model_x() {
  static const auto scene = swallowing::make_scene({.spacing = 2.4e-3, .data = SWALLOWING_DATA});
  return scene;
}

TEST(Pictures, TheModelShowsEveryOrganAndEveryRegion) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "model.png";
  const Snapshot s = at_rest(model_x());
  const std::set<std::string> letters = swallowing::draw_model(path, s, "the model");
  std::set<std::string> wanted{"H"};
  for (const auto& region : swallowing::body_regions(swallowing::Model::X))
    wanted.insert(swallowing::letter_of(region.name));
  EXPECT_EQ(letters, wanted);

  // The panels in the order of their letters; of the colours, those of balls at the front.
  const Png model(path);
  const auto in_panel = [&](int panel, auto&& wanted_colour) {
    return model.share(wanted_colour, 18 + 448 * (panel % 4), 106 + 618 * (panel / 4), 430, 560);
  };
  const auto like = [](int R, int G, int B) {
    return [=](int r, int g, int b) { return std::max({std::abs(r - R), std::abs(g - G), std::abs(b - B)}) < 12; };
  };
  const auto tongue = like(0xd9, 0x58, 0x4f), palate = like(0xe8, 0x91, 0x5b), hard = like(0xb9, 0xae, 0x98),
             leaf = like(0xf5, 0xc2, 0x11), vallecula = like(0x3f, 0xa7, 0x96), larynx = like(0x55, 0x96, 0xd6),
             pharynx = like(0xe3, 0xa3, 0xb4), esophagus = like(0x9b, 0x7f, 0xc9), strip = like(0x8a, 0x81, 0x72);
  for (const auto& colour : {tongue, palate, hard, leaf, vallecula, larynx, pharynx, esophagus, strip})
    EXPECT_GT(in_panel(0, colour), 1e-3);
  const std::array alone{tongue, tongue, palate, leaf, leaf, pharynx};
  for (std::size_t k = 0; k < alone.size(); ++k) EXPECT_GT(in_panel(static_cast<int>(k) + 1, alone[k]), 1e-3) << k;
  for (const int panel : {1, 2, 3}) EXPECT_LT(in_panel(panel, larynx), 1e-5) << panel;

  // Regions are dark, but not among all organs.
  Snapshot bright = s;
  for (Role& role : bright.role)
    if (role == Role::control) role = Role::free;
  (void)swallowing::draw_model(path, bright, "the same without dark regions");
  const Png without(path);
  constexpr auto dim = [](int r, int g, int b) { return r < 125 && g < 125 && b < 125; };
  const auto darkened = [&](int panel) {
    const int left = 18 + 448 * (panel % 4), top = 106 + 618 * (panel / 4);
    return model.share(dim, left, top, 430, 560) - without.share(dim, left, top, 430, 560);
  };
  EXPECT_EQ(darkened(0), 0);
  for (int panel = 1; panel <= 6; ++panel) EXPECT_GT(darkened(panel), 2e-3) << panel;
}

TEST(Pictures, ARegionThatIsMissingHasNoLetter) {
  const TemporaryFolder folder;
  Snapshot s = at_rest(model_x());
  for (std::size_t i = 0; i < s.positions.size(); ++i)
    if (s.region[i] != Snapshot::no_region && s.regions[s.region[i]] == "F")
      s.region[i] = Snapshot::no_region, s.role[i] = Role::free;  // as in model Y
  const auto letters = swallowing::draw_model(folder.path() / "model.png", s, "model Y");
  EXPECT_FALSE(letters.contains("F"));
  EXPECT_TRUE(letters.contains("E") && letters.contains("G") && letters.contains("H"));
}

/// The particles of some organs of the scene.
swallowing::Scene part_of(const swallowing::Scene& scene, const std::set<swallowing::Organ>& organs) {
  swallowing::Scene part;
  part.spacing = scene.spacing;
  part.regions = scene.regions;
  for (std::size_t i = 0; i < scene.reference.size(); ++i) {
    if (!organs.contains(scene.organ[i])) continue;
    part.reference.push_back(scene.reference[i]);
    part.organ.push_back(scene.organ[i]);
    part.region.push_back(scene.region[i]);
    part.elastic_count += i < scene.elastic_count;
  }
  return part;
}

/// Epiglottis, soft palate and plates.
const swallowing::Scene& leaf_and_palate() {
  using swallowing::Organ;
  static const auto scene = part_of(model_x(), {Organ::epiglottis, Organ::soft_palate, Organ::constrictors});
  return scene;
}
const swallowing::CarriedOrgans& their_surfaces() {
  static const swallowing::CarriedOrgans organs(leaf_and_palate(), 1);
  return organs;
}

TEST(Pictures, TheSurfacesOfTheOrgansAreClosedAndHoldTheRightHalf) {
  using swallowing::Organ;
  const auto& organs = their_surfaces();
  const Snapshot s = at_rest(leaf_and_palate());
  const auto vertices = organs.vertices(s.positions);
  ASSERT_EQ(vertices.size(), organs.organ().size());
  std::map<std::pair<hmps::Index, hmps::Index>, int> edges;
  std::map<Organ, double> volume, cut;
  for (std::size_t t = 0; t < organs.triangles().size(); ++t) {
    const auto& corners = organs.triangles()[t];
    std::array<Eigen::Vector3d, 3> at;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = Eigen::Map<const Eigen::Vector3f>(vertices[corners[k]].data()).cast<double>();
      ++edges[std::minmax(corners[k], corners[(k + 1) % 3])];
      EXPECT_GT(at[k][1], -0.1e-3);
      EXPECT_TRUE(!organs.cut(t) || at[k][1] < 0.7e-3);
    }
    const Organ organ = organs.organ()[corners[0]];
    volume[organ] += at[0].dot(at[1].cross(at[2])) / 6;
    if (organs.cut(t)) cut[organ] += (at[2] - at[0]).cross(at[1] - at[0])[1] / 2;
  }
  for (const auto& [edge, count] : edges) ASSERT_EQ(count, 2) << edge.first << ' ' << edge.second;
  for (const Organ organ : {Organ::epiglottis, Organ::soft_palate}) {
    const auto particles = std::count(leaf_and_palate().organ.begin(), leaf_and_palate().organ.end(), organ);
    const double half = static_cast<double>(particles) / 2 * std::pow(2.4e-3, 3);
    EXPECT_NEAR(volume[organ] / half, 1, 0.15) << name(organ);  // the lattice cuts sheets of two particles
  }
  EXPECT_NEAR(cut[Organ::epiglottis] / (36e-3 * 4.8e-3), 1, 0.05) << "length times thickness";
}

TEST(Pictures, TheSurfacesMoveWithTheParticles) {
  const auto& organs = their_surfaces();
  Snapshot s = at_rest(leaf_and_palate());
  const auto before = organs.vertices(s.positions);
  for (auto& p : s.positions) p = {p[0] + 3e-3f, 1.2f * p[1], p[2] - 0.1f * p[0]};
  const auto after = organs.vertices(s.positions);
  for (std::size_t v = 0; v < before.size(); ++v) {
    EXPECT_NEAR(after[v][0], before[v][0] + 3e-3f, 1e-6);
    EXPECT_NEAR(after[v][1], 1.2f * before[v][1], 1e-6);
    EXPECT_NEAR(after[v][2], before[v][2] - 0.1f * before[v][0], 1e-6);
  }
}

TEST(Pictures, SurfacesAreDrawnInTheColoursOfTheirOrgans) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "surfaces.png";
  const Snapshots snapshots(folder.path() / "snapshots");
  Snapshot s = at_rest(leaf_and_palate());
  const auto draw = [&] {
    snapshots.add(0, s);
    swallowing::draw_surfaces(path, snapshots, their_surfaces(), "surfaces");
    return Png(path);
  };
  // The first panel, 400 pixels wide: the palate above, the leaf below; what is cut has the plain colour.
  constexpr auto palate = [](int r, int g, int b) { return r == 0xe8 && g == 0x91 && b == 0x5b; };
  constexpr auto leaf = [](int r, int g, int b) { return r == 0xf5 && g == 0xc2 && b == 0x11; };
  constexpr auto white = [](int r, int g, int b) { return r == 255 && g == 255 && b == 255; };
  const Png picture = draw();
  const int height = cairo_image_surface_get_height(picture.surface) / 2 - 106;
  const auto above = [&](const Png& p, auto&& colour) { return p.share(colour, 18, 106, 400, height / 2); };
  const auto below = [&](const Png& p, auto&& colour) {
    return p.share(colour, 18, 106 + height / 2, 400, height / 2);
  };
  EXPECT_GT(above(picture, palate), 0.01);
  EXPECT_EQ(below(picture, palate), 0);
  EXPECT_GT(below(picture, leaf), 0.01);
  EXPECT_EQ(above(picture, white), 0) << "the ground shows through where nothing is";

  // The palate, moved before the leaf, hides it; behind it, on the right, it does not.
  const auto leaf_beside_palate = [&](float sideways) {
    s = at_rest(leaf_and_palate());
    for (std::size_t i = 0; i < s.positions.size(); ++i)
      if (s.organ_of(i) == "soft palate")
        s.positions[i] = {s.positions[i][0] + 4e-3f, s.positions[i][1] + sideways, s.positions[i][2] - 0.05f};
    return draw().share(leaf);
  };
  const double behind = leaf_beside_palate(0.03f), before = leaf_beside_palate(-0.03f);
  EXPECT_GT(behind, 1e-3);
  EXPECT_LT(before, 0.85 * behind);
}

/// A sheet of one organ across the midsagittal plane.
Snapshot sheet_of(const std::string& organ, float x, float height) {
  Snapshot s;
  s.spacing = 2e-3;
  s.organs = {organ};
  for (int j = -8; j <= 8; ++j)
    for (int k = -8; k <= 8; ++k) {
      s.positions.push_back({x, 2e-3f * static_cast<float>(j), height + 2e-3f * static_cast<float>(k)});
      s.organ.push_back(0);
      s.role.push_back(Role::free);
      s.region.push_back(Snapshot::no_region);
    }
  return s;
}

TEST(Pictures, FromBehindTheLeafIsNotHiddenByTheWall) {
  const TemporaryFolder folder;
  const Snapshots snapshots(folder.path() / "snapshots");
  const auto path = folder.path() / "rear.png";
  const auto drawn = [&](const Snapshot& s) {
    snapshots.add(1.583, s);
    swallowing::draw_rear(path, snapshots, "rear");
    return Png(path);
  };
  EXPECT_GT(drawn(sheet_of("epiglottis", -5e-3f, 45e-3f)).share(yellow), 5e-3);
  constexpr auto pink = [](int r, int g, int b) { return r > 200 && g < 200 && b > 150 && r > g + 20; };
  EXPECT_LT(drawn(sheet_of("pharynx", 10e-3f, 45e-3f)).share(pink), 1e-4) << "the posterior wall is removed";
  EXPECT_GT(drawn(sheet_of("pharynx", -5e-3f, 45e-3f)).share(pink), 1e-3) << "the right side wall stays";
}

TEST(Pictures, SectionsShowTheirHeight) {
  const TemporaryFolder folder;
  const Snapshots snapshots(folder.path() / "snapshots");
  const auto path = folder.path() / "sections.png";
  snapshots.add(1.667, sheet_of("tongue", 0, 40e-3f));
  swallowing::draw_sections(path, snapshots, "sections");
  EXPECT_GT(Png(path).share(red), 5e-4);
  snapshots.add(1.667, sheet_of("tongue", 0, 110e-3f));
  swallowing::draw_sections(path, snapshots, "above all sections");
  EXPECT_LT(Png(path).share(red), 1e-4) << "only that of the legend";
}

TEST(Pictures, OutlinesOfTwoLeavesAreRedAndYellow) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "outlines.png";
  const std::array<swallowing::NamedSnapshots, 2> both{{{"X1", folder.path() / "a"}, {"Y1", folder.path() / "b"}}};
  const Snapshots first(both[0].folder), second(both[1].folder);
  first.add(1.7, sheet_of("epiglottis", -10e-3f, 40e-3f));
  swallowing::draw_outlines(path, both);
  EXPECT_FALSE(std::filesystem::exists(path)) << "the second leaf is missing";
  second.add(1.7, sheet_of("epiglottis", 5e-3f, 40e-3f));
  swallowing::draw_outlines(path, both);
  const Png outlines(path);
  const double reds = outlines.share([](int r, int g, int b) { return r > 170 && g < 60 && b < 70; });
  const double yellows = outlines.share([](int r, int g, int b) { return r > 200 && g > 150 && b < 60; });
  EXPECT_GT(reds, 2e-3);
  EXPECT_LT(reds, 0.03) << "an outline, not an area";
  EXPECT_NEAR(yellows / reds, 1, 0.3);
}

TEST(Pictures, TableAndFoldIncludeThePaper) {
  const TemporaryFolder folder;
  const auto x1 = folder.path() / "X1";
  std::filesystem::create_directories(x1);
  {
    swallowing::Series series(x1 / "series.csv");
    for (int i = 0; i < 205; ++i) {
      swallowing::Sample sample;
      sample.time = 0.01 * i;
      sample.tip_angle = 60 - 0.4 * i;
      series.add(sample);
    }
  }
  swallowing::Summary summary;
  summary.case_name = "X1";
  summary.friction = 0.1;
  summary.time = 2.05;
  summary.fold_time = 1.662;
  const swallowing::RunSettings settings{{"spacing", "0.0024"}, {"scalar", "float"}};
  summary.settings = settings;
  swallowing::write_summary(x1 / "summary.json", summary);
  summary.settings = {{"spacing", "0.0018"}, {"scalar", "float"}};
  std::filesystem::create_directories(folder.path() / "Y1");
  swallowing::write_summary(folder.path() / "Y1/summary.json", summary);

  const auto results = swallowing::read_results(folder.path(), settings);
  ASSERT_TRUE(results[0].summary);
  EXPECT_EQ(results[0].samples.size(), 205u);
  EXPECT_FALSE(results[2].summary) << "a case of other settings stands in the table";
  EXPECT_EQ(results[2].left_out, "spacing 0.0018 in place of 0.0024");
  EXPECT_FALSE(results[3].summary);
  swallowing::write_table2(folder.path() / "table2.md", results);
  swallowing::draw_fold(folder.path() / "fold.png", results);
  const std::string table = examples::read_file(folder.path() / "table2.md");
  EXPECT_NE(table.find("| X1 | X | 0.1 | 1.65 s | 1.662 s | +12 ms |"), std::string::npos) << table;
  EXPECT_NE(table.find("| Y1 | Y | 0.1 | 1.70 s | other settings |"), std::string::npos) << table;
  EXPECT_NE(table.find("Case Y1 was run with other settings: spacing 0.0018"), std::string::npos) << table;
  EXPECT_NE(table.find("| Y3 | Y | 0.3 | did not fold | not run |"), std::string::npos) << table;
  EXPECT_GT(Png(folder.path() / "fold.png").share([](int r, int g, int b) { return r > 170 && g < 60 && b < 70; }),
            1e-3);
}

}  // namespace pictures_test
