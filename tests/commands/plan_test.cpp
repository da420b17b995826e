// swiftlet plan as users meet it: a path in any map of a building, or why there is none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "interfaces/clouds/point_cloud.hpp"
#include "interfaces/files/octomap.hpp"
#include "tests/commands/refusals.hpp"
#include "tests/support/program.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::runSwiftlet;
using testing::HasSubstr;

class Plan : public Refusals {
 protected:
  static ProgramEnd plan(const std::string& map, std::vector<std::string> options) {
    options.insert(options.begin(), {"plan", map});
    return runSwiftlet(options);
  }
  static nlohmann::json jsonOf(const std::string& map, std::vector<std::string> options, int exit_code = 0) {
    options.push_back("--json");
    const ProgramEnd end = plan(map, options);
    EXPECT_EQ(end.exit_code, exit_code) << describe(end);
    return nlohmann::json::parse(end.out, nullptr, false);
  }

  /// 8 x 5 m in cells of 0.1 m from (-1, -1) on, with walls, a wall at x = 3 m that ends 1.5 m below the top, and a
  /// closed cell of 1.4 m in a corner.
  std::string floorPlan(const std::string& yaw = "0") {
    std::string pixels;
    for (int row = 0; row < 50; ++row)
      for (int column = 0; column < 80; ++column) {
        const bool border = row == 0 || row == 49 || column == 0 || column == 79;
        const bool wall = column == 40 && row >= 15,
                   chamber = (column == 64 && row >= 34) || (row == 34 && column >= 64);
        pixels += static_cast<char>(border || wall || chamber ? 0 : 254);
      }
    write("plan.pgm", "P5\n80 50\n255\n" + pixels);
    return write("plan.yaml", "image: plan.pgm\nresolution: 0.1\norigin: [-1, -1, " + yaw +
                                  "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  }

  /// 4 x 3 x 2.4 m in voxels of 0.1 m; a wall at x = 2 m with a window of 1 x 1 m.
  std::string octree() {
    common::VoxelMap map(0.1);
    for (int z = 0; z < 24; ++z)
      for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
          const bool window = z >= 10 && z < 20 && y >= 10 && y < 20;
          map.set({x, y, z}, x == 20 && !window ? std::int8_t{40} : std::int8_t{-40});
        }
    return write("room.bt", toOctree(map, interfaces::OctreeFormat::kBinary));
  }
};

TEST_F(Plan, GoesAroundAWallAndDrawsIt) {
  const std::string map = floorPlan();
  for (const char* planner : {"dstar", "wavefront", "sampling"}) {
    const nlohmann::json json =
        jsonOf(map, {"--from", "1;0", "--to", "5;0", "--planner", planner, "--out", path("path.png")});
    const double least_m = 2.0 * std::hypot(2.0, 2.5);
    EXPECT_GT(json.value("length_m", 0.0), least_m) << planner;
    EXPECT_LT(json.value("length_m", 99.0), 1.3 * least_m) << planner;
    EXPECT_GE(json.value("clearance_m", 0.0), 0.3) << planner;
    EXPECT_GT(json.value("nodes", 0), 0) << planner;
    EXPECT_EQ(json["points"].front(), (nlohmann::json{1.0, 0.0})) << planner;
    EXPECT_GT(std::filesystem::file_size(path("path.png")), 1000U);
    std::filesystem::remove(path("path.png"));
  }
  const ProgramEnd end = plan(map, {"--from", "1;0", "--to", "5;0"});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out,
              testing::ContainsRegex("path: [678]\\.[0-9]+ m with [0-9]+ points, 0\\.[0-9]+ m from what is in"));
  EXPECT_THAT(end.out, HasSubstr("dstar: "));
}

TEST_F(Plan, TakesPlacesInTheFrameOfTheFile) {
  // Turned by 90 degrees about (-1, -1): the same places.
  const nlohmann::json json = jsonOf(floorPlan("1.5707963"), {"--from", "-2;1", "--to", "-2;5"});
  EXPECT_EQ(json["points"].back(), (nlohmann::json{-2.0, 5.0})) << json;
  EXPECT_LT(json.value("length_m", 99.0), 8.5);
}

TEST_F(Plan, SaysWhyThereIsNoPathAndTheNearestPlace) {
  const std::string map = floorPlan();
  for (const char* planner : {"dstar", "wavefront", "sampling"}) {
    const auto refusal = [&](const std::string& from, const std::string& to) {
      return jsonOf(map, {"--from", from, "--to", to, "--planner", planner}, 1);
    };
    const nlohmann::json walled = refusal("1;0", "6;0");
    EXPECT_THAT(walled.value("refusal", ""), HasSubstr("unreachable")) << planner;
    const double x = walled["nearest"][0], y = walled["nearest"][1];
    EXPECT_LT(std::hypot(x - 6.0, y - 0.0), 1.6) << planner << walled;
    EXPECT_EQ(jsonOf(map, {"--from", "1;0", "--to", std::to_string(x) + ";" + std::to_string(y)}).count("points"), 1U);
    EXPECT_NE(refusal("1;0", "3.05;0").value("refusal", ""), "") << planner;
    EXPECT_NE(refusal("3.05;0", "1;0").value("refusal", ""), "") << planner;
    EXPECT_THAT(refusal("1;0", "90;0").value("refusal", ""), HasSubstr("outside")) << planner;
    EXPECT_THAT(refusal("90;0", "1;0").value("refusal", ""), HasSubstr("outside")) << planner;
  }
  const ProgramEnd end = plan(map, {"--from", "1;0", "--to", "6;0"});
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_THAT(end.out, testing::ContainsRegex("no path: .*unreachable.*, the nearest place is \"[0-9.]+;[-0-9.]+\""));
}

TEST_F(Plan, GoesThroughAWindowOfAnOctree) {
  const std::string map = octree();
  const nlohmann::json json = jsonOf(map, {"--from", "1;1.5;0.5", "--to", "3;1.5;0.5"});
  EXPECT_EQ(json.value("planner", ""), "sampling");
  EXPECT_GT(json.value("length_m", 0.0), 2.2);
  EXPECT_LT(json.value("length_m", 9.0), 3.2);
  EXPECT_EQ(jsonOf(map, {"--from", "1;1.5;0.5", "--to", "3;1.5;0.5", "--seed", "1"})["points"].size() >= 3, true);
  // At one height the wall is closed, or open in the window's.
  EXPECT_EQ(jsonOf(map, {"--from", "1;1.5;0.5", "--to", "3;1.5;0.5", "--planner", "dstar"}, 1).count("refusal"), 1U);
  EXPECT_LT(jsonOf(map, {"--from", "1;1.5;1.5", "--to", "3;1.5;1.5", "--planner", "dstar"}).value("length_m", 9.0),
            2.1);
  expectRefused(plan(map, {"--from", "1;1.5;0.5", "--to", "3;1.5;0.7", "--planner", "dstar"}), "plans at one height");
}

TEST_F(Plan, TakesWhatHasNoPointOfACloudAsFree) {
  std::vector<common::SurfacePoint> points;
  for (double y = 0.0; y <= 3.0; y += 0.08)
    for (double z = 0.0; z <= 2.5; z += 0.08)
      for (const double x : {0.0, 2.0, 4.0})
        if (x != 2.0 || z < 1.0) points.emplace_back().position_m = Eigen::Vector3d(x, y, z).cast<float>();
  const std::string file = path("room.pcd");
  ASSERT_TRUE(interfaces::writeCloud(file, points));
  const nlohmann::json json = jsonOf(file, {"--from", "1;1.5;0.5", "--to", "3;1.5;0.5"});
  EXPECT_GT(json.value("length_m", 0.0), 2.0 * std::hypot(1.0, 0.6));  // Over the wall, its hull clear of the top.
}

TEST_F(Plan, FindsTheOptimalLengthsOfAScenario) {
  const std::string map =
      write("small.map", "type octile\nheight 5\nwidth 7\nmap\n.......\n.@@@@@.\n.@...@.\n.@.@.@.\n...@...\n");
  // By hand: no corner is cut.
  const std::string head = "version 1\n";
  const std::string right =
      "0 small.map 7 5 0 0 6 0 6\n0 small.map 7 5 2 3 4 3 4\n0 small.map 7 5 0 4 6 4 10\n"
      "0 small.map 7 5 3 2 3 2 0\n0 small.map 7 5 0 0 2 2 8\n";
  const ProgramEnd end = plan(map, {"--problems", write("small.scen", head + right)});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("5 of 5 lengths are the optimal ones"));
  const ProgramEnd wrong =
      plan(map, {"--problems", write("wrong.scen", head + right + "0 small.map 7 5 0 0 6 4 9.4\n")});
  EXPECT_EQ(wrong.exit_code, 1) << describe(wrong);
  EXPECT_THAT(wrong.out, testing::ContainsRegex("wrong.scen:7: 10\\.00000, optimal 9\\.40000"));
}

TEST_F(Plan, SolvesProblemsOfAVoxelMap) {
  // A wall at x = 2 with one free voxel at (2, 3, 1): diagonal steps past its edges would cut corners.
  std::string map = "voxel 5 4 3\n";
  for (int y = 0; y < 4; ++y)
    for (int z = 0; z < 3; ++z)
      if (y != 3 || z != 1) map += "2 " + std::to_string(y) + " " + std::to_string(z) + "\n";
  const std::string file = write("small.3dmap", map), head = "version 1\nsmall.3dmap\n";
  const std::string right = "0 3 1 4 3 1 4 1\n1 2 1 3 2 1 4 1\n0 0 0 1 1 1 1.73205081 1\n0 0 0 0 0 0 0 1\n";
  const ProgramEnd end = plan(file, {"--problems", write("small.3dscen", head + right)});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("4 of 4 lengths are the optimal ones"));
  const ProgramEnd two = plan(file, {"--problems", path("small.3dscen"), "--drawn", "2", "--seed", "3"});
  EXPECT_THAT(two.out, HasSubstr("2 of 2 lengths are the optimal ones"));
  const ProgramEnd wrong = plan(file, {"--problems", write("wrong.3dscen", head + "0 0 0 1 1 1 1.9 1\n")});
  EXPECT_EQ(wrong.exit_code, 1) << describe(wrong);
  expectRefused(plan(file, {"--problems", write("far.3dscen", head + "0 0 0 5 1 1 1.9 1\n")}), "far.3dscen:3");
  expectRefused(plan(write("no.3dmap", "2 2 2\n"), {"--problems", path("small.3dscen")}), "no.3dmap:1");
}

TEST_F(Plan, RefusesWhatIsNoQuestion) {
  const std::string map = floorPlan();
  expectRefused(plan(map, {"--from", "1;0"}), "--to: is missing");
  expectRefused(plan(map, {"--from", "1;0;1", "--to", "5;0"}), "--from: `1;0;1` is no place of this map");
  expectRefused(plan(map, {"--from", "nan;0", "--to", "5;0"}), "--from: `nan;0` is no place of this map");
  expectRefused(plan(map, {"--from", "1;0", "--to", "5;0", "--out", path("none/path.png")}), "--out");
  expectRefused(plan(map, {"--problems", "a.scen", "--from", "1;0"}), "--problems: goes with no place");
  expectRefused(plan(map, {"--problems", "a.scen"}), "is no .map or .3dmap of the Moving AI");
  expectRefused(plan(write("notes.txt", "x"), {"--from", "1;0", "--to", "5;0"}), "is not a kind of map");
}

}  // namespace
}  // namespace swiftlet::commands
