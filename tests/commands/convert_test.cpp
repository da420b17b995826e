// swiftlet convert as users meet it: octrees between their formats, floor plans, and input that cannot be used.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>

#include <fmt/format.h>

#include "common/voxel_map.hpp"
#include "interfaces/clouds/point_cloud.hpp"
#include "interfaces/files/map_server.hpp"
#include "interfaces/files/octomap.hpp"
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
using testing::Not;

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
  const ProgramEnd end = runSwiftlet({"convert", room("room.bt"), path("plan.yaml"), "--low", "+0.8", "--high", "1.2"});
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
  const auto points = interfaces::readCloud(path("room.pcd")).points;
  EXPECT_EQ(points.size(), 20U * 10 + 10 * 14);
  const common::VoxelMap map = interfaces::readOctree(from).map, again = interfaces::readOctree(path("again.bt")).map;
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
  refused({"convert", from, path("room.ot"), "--high", "1"}, "--high: heights are those of a floor plan");
  refused({"convert", from, path("PLAN.YAML"), "--low", "0", "--high", "2"}, "or .yaml for a floor plan");
  refused({"convert", from, path("room.ot"), "--resolution", "0.1"}, "only a cloud");
  refused({"convert", write("room.dae", "<COLLADA/>\n"), path("room.ot")}, "it must be .bt, .ot, .ply or .pcd");
  refused({"convert", write("room.xyz", "1 2 3\n"), path("room.ot")}, "save it as .ply");
  refused({"convert", from, path("room.ot"), "--scale", "0.001"}, "only the coordinates of a cloud");
  refused({"convert", write("text.pcd", "hello\n"), path("room.ot"), "--origin", "1,2,3"}, "`1,2,3` is not x;y;z");
  refused({"convert", write("text.ply", "hello\n"), path("room.ot")}, "does not begin with `ply`");
  refused({"convert", path("none.pcd"), path("room.ot")}, "none.pcd");
  refused({"convert", path("none.bt"), path("room.ot")}, "none.bt");
  // A cube of 512 voxels beside the origin.
  std::string solid = "# Octomap OcTree binary file\nid OcTree\nres 0.05\ndata\n";
  for (int depth = 0; depth < 6; ++depth) solid += depth == 0 ? std::string("\0\xc0", 2) : std::string("\x03\0", 2);
  refused({"convert", write("solid.bt", solid + std::string("\x02\0", 2)), path("room.ply")},
          "its 134217728 occupied voxels are more than");
  refused({"convert", write("text.bt", "hello\n"), path("room.ot")}, "begins with `hello`");
  EXPECT_FALSE(std::filesystem::exists(path("room.ot")));
}

/// A cloud in text with these rows.
std::string cloudOf(std::size_t points, const std::string& rows) {
  return fmt::format("FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nPOINTS {}\nDATA ascii\n{}", points, rows);
}

TEST_F(Convert, ReadsAPackedCloudAndRefusesADamagedOne) {
  const std::string plain = write("room.pcd", cloudOf(2, "1 1 1\n2 2 2\n"));
  ASSERT_EQ(std::system(("gzip -f '" + plain + "'").c_str()), 0);
  const ProgramEnd end = runSwiftlet({"convert", plain + ".gz", path("room.ply")});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_EQ(interfaces::readCloud(path("room.ply")).points.size(), 2U);
  const ProgramEnd damaged = runSwiftlet({"convert", write("room.pcd.xz", "123"), path("room.ot")});
  EXPECT_EQ(damaged.exit_code, 2) << describe(damaged);
}

TEST_F(Convert, SaysHowManyPointsAreLeftOut) {
  const ProgramEnd end =
      runSwiftlet({"convert", write("some.pcd", cloudOf(4, "1 1 1\nnan nan nan\n2 2 2\n5000 0 0\n")), path("some.ot")});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("note: 1 of 4 points left out: without a finite position"));
  EXPECT_THAT(end.out, HasSubstr("note: 1 of 3 points left out: farther than 1638 m from the origin"));
  const auto refused = [&](const std::string& rows, const std::string& text) {
    const ProgramEnd refusal = runSwiftlet({"convert", write("bad.pcd", cloudOf(1, rows)), path("bad.ot")});
    EXPECT_EQ(refusal.exit_code, 2) << describe(refusal);
    EXPECT_THAT(refusal.err, HasSubstr(text));
    EXPECT_FALSE(std::filesystem::exists(path("bad.ot")));
  };
  refused("nan nan nan\n", "all of its 1 point are without a finite position");
  refused("5000 0 0\n", "farther than 1638 m from the origin");
  refused("512345.67 5412345.67 100\n", "would be rounded by up to");
}

TEST_F(Convert, AsksForTheUnitWhereMostPointsAreFarAndTakesOneThatIsGiven) {
  // A room of 4 m in millimetres whose corner is the origin.
  const std::string room = write("mm.pcd", cloudOf(4, "0 0 100\n4000 0 100\n0 4000 100\n4010 4010 2410\n"));
  const ProgramEnd far = runSwiftlet({"convert", room, path("far.bt")});
  ASSERT_EQ(far.exit_code, 0) << describe(far);
  EXPECT_THAT(far.out, HasSubstr("note: 3 of 4 points left out"));
  EXPECT_THAT(
      far.out,
      HasSubstr(
          "left out: farther than 1638 m from the origin, where an octree of this resolution ends: "
          "are they in metres? Give --scale 0.01 if in centimetres, 0.001 if in millimetres, 0.0254 if in inches"));
  const ProgramEnd near = runSwiftlet({"convert", room, path("near.bt"), "--scale", "0.001"});
  ASSERT_EQ(near.exit_code, 0) << describe(near);
  EXPECT_THAT(near.out, Not(HasSubstr("note:")));
  const common::VoxelMap map = interfaces::readOctree(path("near.bt")).map;
  EXPECT_TRUE(map.isOccupied(map.voxelAt({4.01, 4.01, 2.41})));
}

TEST_F(Convert, AsksForTheUnitWhereAGoodShareIsFarAndOfClouds) {
  std::string rows = "4000 0 100\n";
  for (int i = 0; i < 4; ++i) rows += "0 0 100\n";
  const std::string room = write("mm.pcd", cloudOf(5, rows));
  EXPECT_THAT(runSwiftlet({"convert", room, path("mm.bt")}).out, HasSubstr("1 of 5 points left out"));
  EXPECT_THAT(runSwiftlet({"convert", room, path("mm.bt")}).out, HasSubstr("are they in metres?"));
  EXPECT_THAT(runSwiftlet({"convert", room, path("mm.ply")}).out, HasSubstr("reach over 4000 m: are they in metres?"));
  EXPECT_THAT(runSwiftlet({"convert", room, path("m.ply"), "--scale", "0.001"}).out, Not(HasSubstr("metres")));
}

TEST_F(Convert, SaysThatAMapIsEmpty) {
  const std::string empty = write("empty.pcd", cloudOf(0, ""));
  EXPECT_THAT(runSwiftlet({"convert", empty, path("empty.ply")}).out, HasSubstr("empty.pcd holds no points"));
  EXPECT_THAT(runSwiftlet({"convert", empty, path("empty.bt")}).out, HasSubstr("empty.pcd holds no points"));
  EXPECT_THAT(runSwiftlet({"convert", path("empty.bt"), path("e.ply")}).out, HasSubstr("holds no occupied voxels"));
}

/// No point of them is far enough to be left out.
TEST_F(Convert, AsksForTheUnitOfWhatIsTooTallForABuilding) {
  const std::string room = write("cm.pcd", cloudOf(2, "0 0 10\n400 400 240\n"));
  for (const std::vector<std::string>& to :
       {std::vector<std::string>{path("cm.bt")}, {path("cm.yaml"), "--low", "0", "--high", "300"}}) {
    std::vector<std::string> arguments{"convert", room};
    arguments.insert(arguments.end(), to.begin(), to.end());
    EXPECT_THAT(runSwiftlet(arguments).out, HasSubstr("reach over 230 m of height: are they in metres?"));
    arguments.insert(arguments.end(), {"--scale", "0.01"});
    EXPECT_THAT(runSwiftlet(arguments).out, Not(HasSubstr("metres")));
  }
}

TEST_F(Convert, SaysTheUnitThatAHeaderNames) {
  const auto out = [&](const std::string& comment, const std::vector<std::string>& more = {}) {
    const std::string cloud = write("unit.ply", "ply\nformat ascii 1.0\n" + comment +
                                                    "\nelement vertex 2\nproperty float x\nproperty float y\n"
                                                    "property float z\nend_header\n0 0 0\n1 1 1\n");
    std::vector<std::string> arguments{"convert", cloud, path("unit.pcd")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runSwiftlet(arguments).out;
  };
  EXPECT_THAT(out("comment units: centimeters"),
              HasSubstr("note: " + path("unit.ply") + ":3: its header says centimeters: give --scale 0.01\n"));
  EXPECT_THAT(out("comment unit: mm"), HasSubstr("says mm: give --scale 0.001"));
  EXPECT_THAT(out("obj_info inches"), HasSubstr("says inches: give --scale 0.0254"));
  EXPECT_THAT(out("obj_info units=millimeter"), HasSubstr("says millimeter: give --scale 0.001"));
  EXPECT_THAT(out("comment units: mm", {"--scale", "0.001"}), Not(HasSubstr("note:")));
  EXPECT_THAT(out("comment units: mm", {"--scale", "1"}), Not(HasSubstr("note:")));
  for (const std::string none : {"comment metres", "comment units: m", "comment scanned in 5 cm steps"})
    EXPECT_THAT(out(none), Not(HasSubstr("note:"))) << none;
  const std::string room = write("cm.pcd", "# units: centimetres\n" + cloudOf(2, "0 0 10\n400 400 240\n"));
  const std::string of_pcd = runSwiftlet({"convert", room, path("cm.ply")}).out;
  EXPECT_THAT(of_pcd, HasSubstr("cm.pcd:1: its header says centimetres: give --scale 0.01"));
  EXPECT_THAT(of_pcd, Not(HasSubstr("are they in metres?"))) << "that is known";
}

TEST_F(Convert, SaysThatPointsLookLikeDegrees) {
  const auto out = [&](const std::string& rows) {
    return runSwiftlet({"convert", write("far.pcd", cloudOf(2, rows)), path("far.ply")}).out;
  };
  const std::string note = "note: the points look like longitude and latitude in degrees: project them to metres first";
  EXPECT_THAT(out("8.5471 47.3763 408\n8.5475 47.3768 412\n"), HasSubstr(note));
  EXPECT_THAT(out("139.7454 35.6586 10\n139.7457 35.6588 60\n"), HasSubstr(note));
  EXPECT_THAT(out("0 0 0\n0.05 0.05 3\n"), Not(HasSubstr("degrees"))) << "a post";
  EXPECT_THAT(out("8.5 47.3 0\n9.5 48.3 4\n"), Not(HasSubstr("degrees"))) << "a box";
}

/// The hint of the refusal, done literally, works.
TEST_F(Convert, NamesAnOriginWhereCoordinatesAreTooGreat) {
  const std::string utm = write("utm.pcd", cloudOf(2, "512345.67 5412345.67 100\n512346.67 5412345.67 102\n"));
  const ProgramEnd refusal = runSwiftlet({"convert", utm, path("utm.bt")});
  EXPECT_EQ(refusal.exit_code, 2);
  EXPECT_THAT(refusal.err, HasSubstr("give --origin '512300;5412300;0'"));
  const ProgramEnd end = runSwiftlet({"convert", utm, path("utm.bt"), "--origin", "512300;5412300;0"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const common::VoxelMap map = interfaces::readOctree(path("utm.bt")).map;
  EXPECT_TRUE(map.isOccupied(map.voxelAt({46.67, 45.67, 102.0})));
}

TEST_F(Convert, SaysWhatAnotherKindOfMapDoesNotKeep) {
  const std::string colored =
      write("red.PLY",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nproperty "
            "float ny\n"
            "property ushort Red\nproperty ushort Green\nproperty ushort Blue\nproperty float time\nend_header\n"
            "1 1 1 1 65535 32768 0 7\n");
  const ProgramEnd cloud = runSwiftlet({"convert", colored, path("red.PCD")});
  ASSERT_EQ(cloud.exit_code, 0) << describe(cloud);
  EXPECT_THAT(cloud.out, HasSubstr("note: columns left out: time\n"));
  EXPECT_THAT(cloud.out, HasSubstr("note: colours go up to 65535: they are taken to be from 0 to 65535\n"));
  EXPECT_THAT(cloud.out, Not(HasSubstr("note: colours left out")));
  EXPECT_EQ(interfaces::readCloud(path("red.PCD")).points.at(0).rgb, (std::array<std::uint8_t, 3>{255, 128, 0}));
  const ProgramEnd octree = runSwiftlet({"convert", colored, path("red.BT")});
  ASSERT_EQ(octree.exit_code, 0) << describe(octree);
  EXPECT_THAT(octree.out, HasSubstr("note: colours left out"));
  EXPECT_THAT(octree.out, HasSubstr("note: normals left out"));
}

/// A red voxel: each level has one child, the last one of the root and the first one below.
TEST_F(Convert, AColorOcTreeBecomesACloudWithColours) {
  std::string tree = "# Octomap OcTree file\nid ColorOcTree\nsize 17\nres 0.05\ndata\n";
  const std::string node("\0\0\x80\x3f\xff\0\0", 7);
  for (int depth = 0; depth < 16; ++depth) tree += node + (depth == 0 ? '\x80' : '\x01');
  tree += node + '\0';
  const std::string file = write("color.ot", tree);
  const ProgramEnd cloud = runSwiftlet({"convert", file, path("color.ply")});
  ASSERT_EQ(cloud.exit_code, 0) << describe(cloud);
  const auto points = interfaces::readCloud(path("color.ply")).points;
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].rgb, (std::array<std::uint8_t, 3>{255, 0, 0}));
  EXPECT_TRUE(points[0].position_m.isApproxToConstant(0.025F));
  const ProgramEnd octree = runSwiftlet({"convert", file, path("color.bt")});
  ASSERT_EQ(octree.exit_code, 0) << describe(octree);
  EXPECT_THAT(octree.out, HasSubstr("note: colours left out: an octree is written without"));
}

TEST_F(Convert, RefusesAFloorPlanThatIsTooLargeToBeReadAgain) {
  const ProgramEnd end = runSwiftlet({"convert", write("far.pcd", cloudOf(2, "-175 0 1\n175 0 1\n")), path("plan.yaml"),
                                      "--low", "0.5", "--high", "1.5", "--resolution", "0.01"});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("the plan would be 35001 by 1 cells of 0.01 m"));
  EXPECT_THAT(end.err, HasSubstr("remove points far away, give a greater --resolution"));
  EXPECT_FALSE(std::filesystem::exists(path("plan.yaml")));
  EXPECT_FALSE(std::filesystem::exists(path("plan.pgm")));
}

TEST_F(Convert, SaysThatAFloorPlanOfACloudHasNoFreeCells) {
  const ProgramEnd end = runSwiftlet(
      {"convert", write("some.pcd", cloudOf(2, "1 1 1\n2 2 1\n")), path("plan.yaml"), "--low", "0.5", "--high", "1.5"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("note: a cloud does not tell where room is free"));
}

}  // namespace
}  // namespace swiftlet::commands
