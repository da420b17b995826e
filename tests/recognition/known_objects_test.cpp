#include "perception/recognition/known_objects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "common/config.hpp"
#include "perception/recognition/walls_beside_scan.hpp"

namespace swiftlet::perception {
namespace {

using testing::Contains;

struct Listed {
  std::vector<KnownObjectConfig> objects;
  void describe(common::config::Fields& fields) { fields.list("objects", objects, "What is looked for."); }
};

std::vector<std::string> problemsOf(const std::string& item) {
  std::vector<std::string> names;
  Listed listed;
  try {
    common::config::YamlReader::fromText("objects:\n  - " + item + "\n", "list.yaml").read(listed);
  } catch (const common::InputError& error) {
    for (const common::Problem& problem : error.problems()) names.emplace_back(problem.message.name());
  }
  return names;
}

TEST(KnownObjects, AListSaysWhatIsWrongWithIt) {
  EXPECT_TRUE(problemsOf("{name: openings}").empty());
  EXPECT_TRUE(problemsOf("{name: dock, tag: 7, width_m: 0.2}").empty());
  EXPECT_THAT(problemsOf("{name: openings, tag: 7}"), Contains("recognition.openings-shape"));
  EXPECT_THAT(problemsOf("{name: window, tag: 7, width_m: 0.2}"), Contains("recognition.name-taken"));
  EXPECT_THAT(problemsOf("{name: dock, width_m: 0.2}"), Contains("recognition.no-look"));
  EXPECT_THAT(problemsOf("{name: dock, tag: 7, picture: a.png, width_m: 0.2}"), Contains("recognition.no-look"));
  EXPECT_FALSE(problemsOf("{name: dock, tag: 7}").empty()) << "no width";
  EXPECT_FALSE(problemsOf("{name: dock, tag: 600, width_m: 0.2}").empty());
}

TEST(KnownObjects, APictureThatIsNoneIsRefused) {
  KnownObjectConfig config;
  config.name = "pad";
  config.picture = "pad.png";
  config.width_m = 0.5;
  config.picture_bytes = "no picture";
  const auto known = KnownObjects::create({config}, {});
  ASSERT_FALSE(known);
  EXPECT_EQ(known.error().element, "pad");
  EXPECT_THAT(known.error().message.text(), testing::HasSubstr("`pad.png`"));
}

// A square room of 4 m, of which the scan sees the half before it.
TEST(WallsBesideScan, AreThoseOfTheMapWhereTheScanHasNoBeam) {
  common::OccupancyGrid grid = common::makeOccupancyGrid(0.05);
  const common::CellIndex low = grid.cellAt({-2.0, -2.0}), high = grid.cellAt({2.0, 2.0});
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      const bool wall = x == low.x || x == high.x || y == low.y || y == high.y;
      grid.set({x, y}, static_cast<common::occupancy::Cell>(wall ? 60 : -60));
    }
  common::LaserScan scan;
  scan.angle_min_rad = -0.5 * std::numbers::pi;
  scan.angle_increment_rad = std::numbers::pi / 360.0;
  scan.range_min_m = 0.1;
  scan.range_max_m = 30.0;
  scan.ranges_m.assign(361, 2.0F);
  scan.ranges_m[180] = std::numeric_limits<float>::quiet_NaN();
  const common::Pose3 T_map_laser = common::lifted({0.5, 0.0, 0.0}, 1.0);
  const auto walls = wallsBesideScan(scan, T_map_laser, grid);
  ASSERT_EQ(walls.size(), 360U) << "behind, and the one beam that is invalid";
  for (const Eigen::Vector3d& wall : walls) {
    const Eigen::Vector3d in_map = T_map_laser * wall;
    EXPECT_NEAR(std::max(std::abs(in_map.x()), std::abs(in_map.y())), 2.0, 0.08);
    EXPECT_NEAR(wall.z(), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace swiftlet::perception
