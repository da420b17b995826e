// swiftlet convert as users meet it: octrees between their formats, floor plans, and input that cannot be used.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/voxel_map.hpp"
#include "interfaces/files/map_server.hpp"
#include "interfaces/files/octomap.hpp"
#include "interfaces/files/point_cloud.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

using interfaces::OctreeFormat;
using test_support::describe;
using test_support::ProgramEnd;
using test_support::readText;
using test_support::runSwiftlet;
using testing::HasSubstr;

class Convert : public test_support::Scratch {
 protected:
  /// A floor of 2 m x 1 m at z = 0 with a wall along its end, as an octree in the folder.
  std::string room(const std::string& name) {
    common::VoxelMap map(0.1);
    for (int x = 0; x < 20; ++x) {
      for (int y = 0; y < 10; ++y) {
        map.set({x, y, 0}, 70);
        for (int z = 1; z < 15; ++z) map.set({x, y, z}, static_cast<std::int8_t>(x == 19 ? 70 : -40));
      }
    }
    return write(name, toOctree(map, interfaces::octreeFormatOf(name)));
  }
};

TEST_F(Convert, AnOctreeToTheOtherFormatAndBackIsTheSameFile) {
  const std::string from = room("room.bt");
  const ProgramEnd there = runSwiftlet({"convert", from, path("room.ot")});
  ASSERT_EQ(there.exit_code, 0) << describe(there);
  EXPECT_THAT(there.out, HasSubstr("room.ot"));
  const ProgramEnd back = runSwiftlet({"convert", path("room.ot"), path("again.bt")});
  ASSERT_EQ(back.exit_code, 0) << describe(back);
  EXPECT_EQ(readText(path("again.bt")), readText(from));
}

TEST_F(Convert, ABandOfHeightsIsAFloorPlan) {
  const ProgramEnd end = runSwiftlet({"convert", room("room.bt"), path("plan.yaml"), "--low", "0.8", "--high", "1.2"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const interfaces::StoredMap plan = interfaces::readMap(path("plan.yaml"));
  const auto at = [&](double x_m, double y_m) {
    const Eigen::Vector2d point = plan.T_map_grid.inverse() * Eigen::Vector2d(x_m, y_m);
    return plan.grid.at(plan.grid.cellAt(point));
  };
  EXPECT_TRUE(common::occupancy::isFree(at(1.05, 0.55)));
  EXPECT_TRUE(common::occupancy::isOccupied(at(1.95, 0.55)));
  EXPECT_TRUE(common::occupancy::isUnknown(at(2.55, 0.55)));
}

TEST_F(Convert, OccupiedVoxelsAreAPointEachAndPointsAreOccupiedVoxels) {
  const std::string from = room("room.ot");
  const auto run = [&](const std::vector<std::string>& arguments) {
    const ProgramEnd end = runSwiftlet(arguments);
    ASSERT_EQ(end.exit_code, 0) << describe(end);
  };
  run({"convert", from, path("room.ply")});
  run({"convert", path("room.ply"), path("room.pcd")});
  run({"convert", path("room.pcd"), path("again.bt"), "--resolution", "0.1"});
  const auto points = interfaces::readCloud(path("room.pcd"));
  EXPECT_EQ(points.size(), 20U * 10 + 10 * 14);
  const common::VoxelMap map = interfaces::readOctree(from), again = interfaces::readOctree(path("again.bt"));
  for (int x = -1; x < 21; ++x)
    for (int y = -1; y < 11; ++y)
      for (int z = -1; z < 16; ++z) ASSERT_EQ(again.isOccupied({x, y, z}), map.isOccupied({x, y, z}));
  run({"convert", path("room.ply"), path("plan.yaml"), "--low", "0.5", "--high", "1.0", "--resolution", "0.1"});
  const interfaces::StoredMap plan = interfaces::readMap(path("plan.yaml"));
  int occupied = 0;
  plan.grid.forEachCell(
      [&](common::CellIndex, common::occupancy::Cell c) { occupied += common::occupancy::isOccupied(c); });
  EXPECT_EQ(occupied, 10) << "the wall";
}

TEST_F(Convert, WhatCannotBeConvertedIsSaid) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& text) {
    const ProgramEnd end = runSwiftlet(arguments);
    EXPECT_EQ(end.exit_code, 2) << describe(end);
    EXPECT_THAT(end.err, HasSubstr(text));
  };
  const std::string from = room("room.bt");
  refused({"convert", from, path("room.obj")}, "`.obj`");
  refused({"convert", from, path("plan.yaml")}, "--low 0.8 --high 1.2");
  refused({"convert", from, path("plan.yaml"), "--low", "2", "--high", "1"}, "is above --high");
  refused({"convert", from, path("plan.yaml"), "--low", "5", "--high", "6"}, "nothing is known");
  refused({"convert", from, path("room.ot"), "--low", "1"}, "name it .yaml");
  refused({"convert", from, path("room.ot"), "--resolution", "0.1"}, "only a cloud");
  refused({"convert", write("room.obj", "v 0 0 0\n"), path("room.ot")}, "it must be .bt, .ot, .ply or .pcd");
  refused({"convert", write("text.ply", "hello\n"), path("room.ot")}, "does not begin with `ply`");
  refused({"convert", path("none.pcd"), path("room.ot")}, "none.pcd");
  refused({"convert", path("none.bt"), path("room.ot")}, "none.bt");
  refused({"convert", write("text.bt", "hello\n"), path("room.ot")}, "begins with `hello`");
  EXPECT_FALSE(std::filesystem::exists(path("room.ot")));
}

}  // namespace
}  // namespace swiftlet::commands
