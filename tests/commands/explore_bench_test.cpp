// swiftlet explore-bench as users meet it: explorers compared in folders of maps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/commands/refusals.hpp"
#include "tests/support/program.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::runSwiftlet;
using testing::HasSubstr;

class ExploreBench : public Refusals {
 protected:
  static ProgramEnd bench(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "explore-bench");
    return runSwiftlet(arguments);
  }
  /// Two rooms of 4 m by 4 m with a door of 1.2 m, cells of 0.1 m.
  std::string floorPlan(const std::string& name) {
    std::string pixels;
    for (int row = 0; row < 42; ++row)
      for (int column = 0; column < 82; ++column) {
        const bool wall = row == 0 || row == 41 || column == 0 || column == 81 || (column == 40 && row >= 12);
        pixels += static_cast<char>(wall ? 0 : 254);
      }
    write(name + ".pgm", "P5\n82 42\n255\n" + pixels);
    return write(name + ".yaml", "image: " + name + ".pgm\nresolution: 0.1\norigin: [-1, -1, 0]\nnegate: 0\n" +
                                     "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  }
};

TEST_F(ExploreBench, ComparesAllExplorersInAFolder) {
  floorPlan("a");
  floorPlan("b");
  const ProgramEnd end = bench({path(""), "--resolution", "0.1"});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("a.yaml from \""));
  EXPECT_THAT(end.out, HasSubstr("b.yaml from \""));
  for (const char* explorer : {"nearest_frontier", "utility", "tour"}) EXPECT_THAT(end.out, HasSubstr(explorer));
  EXPECT_THAT(end.out, testing::ContainsRegex("tour against utility: [0-9.]+x faster, .* means of 2"));
}

TEST_F(ExploreBench, GivesTheFiguresAsJson) {
  const ProgramEnd end =
      bench({floorPlan("a"), "--resolution", "0.1", "--explorer", "tour", "--start", "0;0", "--json"});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  const auto json = nlohmann::json::parse(end.out, nullptr, false);
  ASSERT_TRUE(json.is_array() && json.size() == 1) << end.out;
  EXPECT_NEAR(json[0]["start"][0].get<double>(), 0.0, 0.1);
  ASSERT_EQ(json[0]["flights"].size(), 1u);
  const auto& flight = json[0]["flights"][0];
  EXPECT_EQ(flight["explorer"], "tour");
  EXPECT_EQ(flight["complete"], true);
  EXPECT_GT(flight["explore_s"].get<double>(), 1.0);
  EXPECT_GT(json[0]["bound_m"].get<double>(), 0.5);
}

TEST_F(ExploreBench, FliesTheSimulatedVehicle) {
  const ProgramEnd made = runSwiftlet({"world", floorPlan("a"), "--out", path("a.sdf"), "--start", "1;1;0"});
  ASSERT_EQ(made.exit_code, 0) << describe(made);
  const ProgramEnd end =
      bench({path("a.sdf"), "--fly", "--explorer", "tour", "--seed", "7", "--out", path("runs"), "--json"});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  const auto json = nlohmann::json::parse(end.out, nullptr, false);
  ASSERT_TRUE(json.is_array() && json.size() == 1) << end.out;
  EXPECT_EQ(json[0]["world"], "a.sdf seed 7");
  const auto& flight = json[0]["flights"][0];
  EXPECT_EQ(flight["complete"], true) << flight["failure"];
  EXPECT_GT(flight["explore_s"].get<double>(), 1.0);
  EXPECT_GT(flight["total_s"].get<double>(), flight["explore_s"].get<double>());
  EXPECT_GT(flight["explore_m"].get<double>(), 1.0);
  EXPECT_TRUE(std::filesystem::exists(path("runs/a-tour-007/report.html")));
}

TEST_F(ExploreBench, RefusesWhatIsNoMap) {
  expectRefused(bench({path("none.yaml")}), "none.yaml");
  std::filesystem::create_directory(path("empty"));
  expectRefused(bench({path("empty")}), "has no floor plan, grid or world");
  expectRefused(bench({floorPlan("a"), "--explorer", "fast"}), "`fast` is no explorer");
  expectRefused(bench({floorPlan("a"), "--start", "1"}), "--start: `1` is no place");
  expectRefused(bench({write("cloud.ply", "ply\n")}), "is a map in space");
  expectRefused(bench({path("cloud.ply"), "--fly"}), "is neither a world nor a trial");
}

}  // namespace
}  // namespace swiftlet::commands
