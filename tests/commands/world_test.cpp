// swiftlet world as users meet it: a floor plan, an octree or a cloud becomes a world that a vehicle can stand in.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "interfaces/clouds/point_cloud.hpp"
#include "interfaces/files/octomap.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/world_model.hpp"
#include "tests/commands/refusals.hpp"
#include "tests/support/program.hpp"

namespace swiftlet::commands {
namespace {

namespace fs = std::filesystem;
using test_support::describe;
using test_support::ProgramEnd;
using test_support::readText;
using test_support::runSwiftlet;
using testing::HasSubstr;

class World : public Refusals {
 protected:
  ProgramEnd make(const std::string& from, std::vector<std::string> options = {}) {
    options.insert(options.begin(), {"world", from, "--out", path("made.sdf")});
    return runSwiftlet(options);
  }
  void expectRefused(const ProgramEnd& end, const std::string& pattern) const {
    Refusals::expectRefused(end, pattern);
    EXPECT_FALSE(fs::exists(path("made.sdf")) || fs::exists(path("made.stl"))) << describe(end);
  }

  /// A room of 4 x 3 m, its lower left corner at (-1, -1), with walls of 0.1 m, in cells of 0.1 m; unknown outside.
  std::string plan(const std::string& yaw = "0") {
    std::string pixels;
    for (int row = 0; row < 32; ++row)
      for (int column = 0; column < 42; ++column) {
        const bool wall = row == 0 || row == 31 || column == 0 || column == 41;
        pixels += static_cast<char>(wall ? 0 : 254);
      }
    write("room.pgm", "P5\n42 32\n255\n" + pixels);
    return write("room.yaml", "image: room.pgm\nresolution: 0.1\norigin: [-1.1, -1.1, " + yaw +
                                  "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  }

  /// The same room, 2.4 m high, its floor at 0.5 m, as an octree.
  std::string tree(bool with_free) {
    common::VoxelMap map(0.1);
    for (int x = -11; x < 31; ++x)
      for (int y = -11; y < 21; ++y)
        for (int z = 4; z < 30; ++z) {
          const bool matter = x == -11 || x == 30 || y == -11 || y == 20 || z == 4 || z == 29;
          if (matter || with_free) map.set({x, y, z}, static_cast<std::int8_t>(matter ? 70 : -40));
        }
    return write("room.bt", toOctree(map, interfaces::OctreeFormat::kBinary));
  }

  /// Points of its surfaces, `spacing_m` apart.
  std::string cloud(bool with_floor, double spacing_m = 0.08) {
    std::vector<common::SurfacePoint> points;
    const auto add = [&](double x, double y, double z) {
      points.emplace_back().position_m = Eigen::Vector3d(x, y, z).cast<float>();
    };
    for (double x = -1.0; x <= 3.0; x += spacing_m)
      for (double y = -1.0; y <= 2.0; y += spacing_m) {
        add(x, y, 2.9);
        if (with_floor) add(x, y, 0.45);
      }
    for (double z = 0.45; z <= 2.9; z += spacing_m) {
      for (double x = -1.0; x <= 3.0; x += spacing_m) {
        add(x, -1.0, z);
        add(x, 2.0, z);
      }
      for (double y = -1.0; y <= 2.0; y += spacing_m) {
        add(-1.0, y, z);
        add(3.0, y, z);
      }
    }
    const std::string file = path("room.pcd");
    EXPECT_TRUE(interfaces::writeCloud(file, points));
    return file;
  }

  /// Distances from a point 1 m above the start to the walls ahead and behind, to the floor and to the ceiling.
  std::vector<double> distances() const {
    const simulation::WorldModel world = simulation::loadWorld(path("made.sdf"));
    EXPECT_TRUE(world.warnings.empty());
    const simulation::RayCaster rays(world);
    const common::Pose3 start = world.T_world_start.value_or(common::Pose3{});
    const Eigen::Vector3d from = start.position_m + Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d ahead = start.rotation * Eigen::Vector3d::UnitX();
    std::vector<double> result;
    for (const Eigen::Vector3d& direction : {ahead, Eigen::Vector3d(-ahead), Eigen::Vector3d(-Eigen::Vector3d::UnitZ()),
                                             Eigen::Vector3d(Eigen::Vector3d::UnitZ())})
      result.push_back(rays.cast(from, direction, 100.0).distance_m);
    return result;
  }
  void expectDistances(const std::vector<double>& expected, double tolerance_m) const {
    const std::vector<double> seen = distances();
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(seen[i], expected[i], tolerance_m) << i;
  }
};

TEST_F(World, OfAFloorPlanHasItsWalls) {
  const ProgramEnd end = make(plan());
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("floor plan: 12.0 m2 free, in cells of 0.1 m; what is unknown is wall"));
  EXPECT_THAT(end.out, HasSubstr("assumed: floor at 0.00 m, walls and ceiling of 2.50 m (--height)"));
  EXPECT_THAT(end.out, HasSubstr("12 triangles"));
  expectDistances({3.0, 1.0, 1.0, 1.5}, 1e-5);
}

TEST_F(World, OfATurnedFloorPlanIsTurned) {
  const ProgramEnd end = make(plan("1.5708"), {"--start", "-2.1;0.9;90", "--height", "3"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  expectDistances({2.1, 1.9, 1.0, 2.0}, 1e-3);
}

TEST_F(World, OfAGridHasCellsOfTheSizeThatIsGiven) {
  const std::string grid =
      write("hall.map", "type octile\nheight 5\nwidth 6\nmap\n@@@@@@\n@....@\n@..S.@\n@..G.@\n@@TWO@\n");
  const ProgramEnd end = make(grid, {"--start", "2.5;2.5", "--resolution", "1"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("floor plan: 12.0 m2 free, in cells of 1 m"));
  expectDistances({2.5, 1.5, 1.0, 1.5}, 1e-5);
}

TEST_F(World, OfAnOctreeHasItsFloorAndCeiling) {
  const ProgramEnd end = make(tree(true), {"--start", "1;0.5"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("at the start: floor at 0.50 m (found), ceiling at 2.90 m (found)"));
  expectDistances({2.0, 2.0, 1.0, 1.4}, 1e-5);
}

TEST_F(World, OfAnOctreeWithoutFreeVoxelsIsClosedByThem) {
  const ProgramEnd end = make(tree(false), {"--start", "1;0.5"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("knows no free voxels"));
  expectDistances({2.0, 2.0, 1.0, 1.4}, 1e-5);
}

TEST_F(World, OfACloudHasVoxelsOfTheDistanceOfItsPoints) {
  const ProgramEnd end = make(cloud(true), {"--start", "1;0.5"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("0.080 m apart, in voxels of 0.1 m"));
  EXPECT_THAT(end.out, HasSubstr("(found), ceiling at"));
  EXPECT_THAT(end.out, testing::Not(HasSubstr("reaches the edge")));
  expectDistances({1.95, 1.95, 1.0, 1.35}, 0.1);
}

TEST_F(World, OfACloudWithoutAFloorIsRefusedUntilOneIsGiven) {
  const std::string from = cloud(false);
  expectRefused(make(from, {"--start", "1;0.5"}), "no floor has free space above it.*give --floor");
  const ProgramEnd end = make(from, {"--start", "1;0.5", "--floor", "0.5", "--height", "2"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("floor at 0.50 m (assumed, nothing was measured there)"));
  EXPECT_THAT(end.out, HasSubstr("ceiling at 2.50 m (assumed, nothing was measured there)"));
  expectDistances({1.95, 1.95, 1.0, 1.0}, 0.1);
}

TEST_F(World, AStartWithoutRoomNamesTheNearestPlaceWithRoom) {
  const ProgramEnd end = make(plan(), {"--start", "-0.8;0"});
  expectRefused(end, "--start: at \\(-0\\.80, 0\\.00, 0\\.00\\) is inside or touches .*the nearest place with room");
  const std::size_t begin = end.err.find("--start \"") + 9;
  const std::string place = end.err.substr(begin, end.err.find('"', begin) - begin);
  EXPECT_EQ(make(plan(), {"--start", place}).exit_code, 0) << place;
  fs::remove(path("made.sdf"));
  fs::remove(path("made.stl"));
  expectRefused(make(plan(), {"--start", "20;0"}), "no floor has free space above it.*--start \"2\\.[0-9]+;");
  expectRefused(make(plan(), {"--height", "1"}), "the hull fits nowhere in it");
}

TEST_F(World, NothingThatIsThereIsLost) {
  for (const std::string name : {"made.stl", "made.sdf"}) {
    write(name, "mine");
    Refusals::expectRefused(make(plan()), name + ": --out: is there already");
    EXPECT_EQ(readText(path(name)), "mine");
    EXPECT_FALSE(fs::exists(path(name == "made.stl" ? "made.sdf" : "made.stl")));
    fs::remove(path(name));
  }
  test_support::ProgramOptions full;
  full.largest_file_bytes = 500;
  const ProgramEnd end = runSwiftlet({"world", plan(), "--out", path("made.sdf")}, full);
  expectRefused(end, "made\\.stl: File too large");
}

TEST_F(World, InputThatIsNoBuildingIsRefused) {
  write("grey.pgm", "P5\n4 4\n255\n" + std::string(16, '\xcd'));
  expectRefused(make(write("grey.yaml", "image: grey.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n")),
                "nothing in it is known");
  expectRefused(make(write("empty.bt", toOctree(common::VoxelMap(0.1), interfaces::OctreeFormat::kBinary))),
                "no voxel in it is occupied");
  expectRefused(make(write("empty.ply",
                           "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
                           "property float z\nend_header\n")),
                "it has no points");
  expectRefused(make(cloud(true, 0.8)), "points are 0.55 m apart and more: the hull fits between them");
  expectRefused(make(cloud(true), {"--scale", "1000"}), "the hull fits between them");
  expectRefused(make(cloud(true), {"--resolution", "0.05"}), "--resolution: voxels of 0.05 m are smaller than");
  expectRefused(make(plan(), {"--resolution", "0.05"}), "--resolution: this map has its own");
  expectRefused(make(plan(), {"--floor", "0.05"}), "--floor: the floor of a floor plan is at 0");
  expectRefused(make(tree(true), {"--scale", "0.05"}), "--scale: this map is in metres");
  expectRefused(make(write("arena.map", "type octile\n")), "width or height is missing");
  expectRefused(make(write("arena.3dmap", "voxel 1 1 1\n")), "is not a kind of map");
  expectRefused(make(path("room.pgm")), "is the picture of a map");
  common::VoxelMap far(0.01);
  for (const int place : {0, 30'000}) far.set({place, place, place}, 70);
  expectRefused(make(write("far.bt", toOctree(far, interfaces::OctreeFormat::kBinary))),
                "too far for voxels of 0.01 m");
}

}  // namespace
}  // namespace swiftlet::commands
