// SPDX-License-Identifier: MIT
#include "output/frames.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "../../reference/message_of.hpp"
#include "../../reference/temporary_folder.hpp"

namespace frames_test {

using examples::Field;
using hmps_test::message_of;
using hmps_test::TemporaryFolder;
using swallowing::Frames;

struct Cloud {
  std::vector<std::array<float, 3>> x{{0.f, 0.25f, -1.f}, {1.f, 2.f, 3.f}, {-4.f, 5.5f, 6.f}};
  std::vector<double> j{1.0, 0.5, 1.25};
  std::vector<int> organ{0, 7, 3};

  [[nodiscard]] std::vector<Field> fields() const {
    return {examples::numbers("velocity", hmps::vectors(x)), examples::numbers("J", hmps::scalars(j)),
            examples::whole_numbers("organ", organ)};
  }
  void write(Frames& frames, double time) const {
    const auto point_data = fields();
    frames.add(time, examples::numbers("position", hmps::vectors(x)), point_data);
  }
};

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(Frames, TheListGrowsWithTheFiles) {
  const TemporaryFolder folder;
  Frames frames(folder.path());
  for (int i = 0; i < 4; ++i) {
    Cloud().write(frames, 0.1 * i);
    const std::string list = examples::read_file(folder.path() / "frames.pvd");
    for (const auto& [time, file] : frames.list()) {
      EXPECT_TRUE(std::filesystem::exists(folder.path() / file));
      EXPECT_NE(list.find("timestep=\"" + examples::to_text(time) + "\""), std::string::npos);
      EXPECT_NE(list.find(file), std::string::npos);
    }
  }
  EXPECT_EQ(frames.list().size(), 4u);
}

TEST(Frames, AreTheSameAfterResuming) {
  const TemporaryFolder whole, resumed;
  std::filesystem::create_directories(resumed.path() / "b");
  {
    Frames frames(whole.path());
    for (int i = 0; i < 6; ++i) Cloud().write(frames, 0.1 * i);
  }
  {
    Frames frames(resumed.path() / "b");
    for (int i = 0; i < 5; ++i) Cloud().write(frames, 0.1 * i);
  }
  {
    Frames frames(resumed.path() / "b", 0.2, 3);
    ASSERT_EQ(frames.list().size(), 3u);
    for (int i = 3; i < 6; ++i) Cloud().write(frames, 0.1 * i);
  }
  EXPECT_EQ(examples::read_file(whole.path() / "frames.pvd"), examples::read_file(resumed.path() / "b/frames.pvd"));
  EXPECT_EQ(files_in(whole.path() / "frames"), files_in(resumed.path() / "b/frames"));
}

TEST(Frames, ANewRunRemovesTheFramesOfTheOld) {
  const TemporaryFolder folder;
  {
    Frames frames(folder.path());
    for (int i = 0; i < 5; ++i) Cloud().write(frames, 0.1 * i);
  }
  Frames frames(folder.path());
  Cloud().write(frames, 0);
  EXPECT_EQ(files_in(folder.path() / "frames"), 1u);
}

TEST(Frames, SurfacesHaveAListOfTheirOwn) {
  const TemporaryFolder folder;
  const std::vector<std::array<hmps::Index, 3>> triangles{{0, 1, 2}};
  const Cloud cloud;
  Frames frames(folder.path());
  cloud.write(frames, 0);
  {
    Frames surfaces(folder.path(), {}, 0, "surface");
    for (int i = 0; i < 3; ++i)
      surfaces.add(0.1 * i, examples::numbers("position", hmps::vectors(cloud.x)), cloud.fields(), triangles);
    EXPECT_EQ(surfaces.list().back().second, "surfaces/surface_00002.vtu");
  }
  EXPECT_NE(examples::read_file(folder.path() / "surfaces/surface_00000.vtu").find("NumberOfCells=\"1\""),
            std::string::npos);
  EXPECT_EQ(files_in(folder.path() / "frames"), 1u);
  const Frames resumed(folder.path(), 0.1, 2, "surface");
  EXPECT_EQ(resumed.list().size(), 2u);
  EXPECT_EQ(files_in(folder.path() / "surfaces"), 2u);
  EXPECT_NE(examples::read_file(folder.path() / "surfaces.pvd").find("surface_00001.vtu"), std::string::npos);
  EXPECT_EQ(message_of<hmps::InputError>([&] {
              (void)Frames(folder.path(), 0.1, 3, "surface");
            }).find((folder.path() / "surfaces.pvd").string() + " lists 2 of the 3 surfaces that were written"),
            0u);
}

TEST(Frames, AreNotResumedWhereSomeAreMissing) {
  const TemporaryFolder folder;
  {
    Frames frames(folder.path());
    for (int i = 0; i < 5; ++i) Cloud().write(frames, 0.1 * i);
  }
  const auto refusal = [&] { return message_of<hmps::InputError>([&] { (void)Frames(folder.path(), 0.2, 3); }); };
  const auto second = folder.path() / "frames/frame_00001.vtu", aside = folder.path() / "aside.vtu";
  std::filesystem::rename(second, aside);
  EXPECT_NE(refusal().find("frame_00001.vtu"), std::string::npos) << refusal();
  EXPECT_EQ(files_in(folder.path() / "frames"), 4u) << "frames were removed all the same";
  std::filesystem::rename(aside, second);
  EXPECT_EQ(refusal(), "");
  std::filesystem::remove(folder.path() / "frames.pvd");
  EXPECT_NE(refusal().find("frames.pvd lists 0 of the 3"), std::string::npos) << refusal();
}

TEST(Frames, AFieldOfAnotherSizeIsRefused) {
  const TemporaryFolder folder;
  Frames frames(folder.path());
  const Cloud cloud;
  const std::vector<Field> fields{examples::whole_numbers("organ", std::vector<int>{1, 2})};
  EXPECT_THROW(frames.add(0, examples::numbers("position", hmps::vectors(cloud.x)), fields), hmps::InputError);
}

// The real VTK reads back what was written: read_frames.py beside this file compares every value.
TEST(Frames, CanBeReadByVtk) {
  const std::string python = "/usr/bin/python3 ";
  if (std::system((python + "-c 'import vtk' 2>/dev/null").c_str()) != 0)
    GTEST_SKIP() << "the Python package of VTK is not here: apt-get install --no-install-recommends python3-vtk9";
  const TemporaryFolder folder;
  Frames frames(folder.path());
  Cloud().write(frames, 0);
  Cloud().write(frames, 0.125);
  const auto script = std::filesystem::path(__FILE__).parent_path() / "read_frames.py";
  EXPECT_EQ(std::system((python + script.string() + " " + folder.path().string()).c_str()), 0);
}

}  // namespace frames_test
