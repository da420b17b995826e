#include "perception/recognition/scan_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include <Eigen/LU>

#include "common/random.hpp"
#include "perception/recognition/wall_recognizer.hpp"

namespace swiftlet::perception {
namespace {

using testing::SizeIs;
using Polygon = std::vector<Eigen::Vector2d>;

constexpr double kDegree = std::numbers::pi / 180.0;

/// What a laser in a room of that outline measures, turned by `heading_rad`: 270 degrees, 1081 beams, as a UTM-30LX.
common::LaserScan seen(const Polygon& room, double heading_rad, double sigma_m, std::uint64_t seed) {
  common::RandomStream random(seed, "scan_lines_test");
  common::LaserScan scan;
  scan.angle_min_rad = -135.0 * kDegree;
  scan.angle_increment_rad = 0.25 * kDegree;
  scan.range_min_m = 0.1;
  scan.range_max_m = 30.0;
  for (int i = 0; i < 1081; ++i) {
    const double angle = heading_rad + scan.angle_min_rad + i * scan.angle_increment_rad;
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < room.size(); ++k) {
      const Eigen::Vector2d from = room[k], along = room[(k + 1) % room.size()] - from;
      const double determinant = ray.x() * -along.y() + ray.y() * along.x();
      if (std::abs(determinant) < 1e-12) continue;
      const double range = (from.x() * -along.y() + from.y() * along.x()) / determinant;
      const double share = (ray.x() * from.y() - ray.y() * from.x()) / determinant;
      if (range > 0.0 && share >= 0.0 && share <= 1.0) nearest = std::min(nearest, range);
    }
    scan.ranges_m.push_back(static_cast<float>(nearest + random.gaussian(sigma_m)));
  }
  return scan;
}

/// An L: five corners of a room, and one that stands out at (1, 1).
const Polygon kRoom = {{-2.0, -1.5}, {4.0, -1.5}, {4.0, 1.0}, {1.0, 1.0}, {1.0, 3.0}, {-2.0, 3.0}};

Eigen::Vector2d inRoom(const Eigen::Vector2d& point_laser_m, double heading_rad) {
  return {std::cos(heading_rad) * point_laser_m.x() - std::sin(heading_rad) * point_laser_m.y(),
          std::sin(heading_rad) * point_laser_m.x() + std::cos(heading_rad) * point_laser_m.y()};
}

TEST(ScanLines, WallsAndCornersAreWithinTwoCentimetresAndOneDegree) {
  const ScanLineConfig config;
  std::vector<double> corner_errors_m, heading_errors_deg, wall_errors_deg, wall_errors_m;
  double squared = 0.0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const double heading = 0.1 * static_cast<double>(seed);
    const auto lines = findLines(seen(kRoom, heading, config.range_sigma_m, seed), config);
    for (const ScanLine& line : lines) {
      // Every wall runs along an axis of the room.
      const double angle = std::remainder(line.angle_rad + heading, 0.5 * std::numbers::pi);
      wall_errors_deg.push_back(std::abs(angle) / kDegree);
      const Eigen::Vector2d middle = inRoom(0.5 * (line.begin_m + line.end_m), heading);
      double nearest = 1e9;
      for (const double x : {-2.0, 4.0, 1.0}) nearest = std::min(nearest, std::abs(middle.x() - x));
      for (const double y : {-1.5, 1.0, 3.0}) nearest = std::min(nearest, std::abs(middle.y() - y));
      wall_errors_m.push_back(nearest);
    }
    for (const ScanCorner& corner : findCorners(lines, config)) {
      const Eigen::Vector2d at = inRoom(corner.point_m, heading);
      double nearest = 1e9;
      Eigen::Vector2d error;
      for (const Eigen::Vector2d& truth : kRoom)
        if ((at - truth).norm() < nearest) {
          nearest = (at - truth).norm();
          error = inRoom(corner.point_m, 0.0) - inRoom(truth, -heading);
        }
      corner_errors_m.push_back(nearest);
      squared += error.dot(corner.covariance.topLeftCorner<2, 2>().inverse() * error) / 2.0;
      const double bisector =
          std::remainder(corner.heading_rad + heading - 0.25 * std::numbers::pi, 0.5 * std::numbers::pi);
      heading_errors_deg.push_back(std::abs(bisector) / kDegree);
    }
  }
  const auto high = [](std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() * 95 / 100];
  };
  EXPECT_GT(corner_errors_m.size(), 150U);
  EXPECT_LT(high(corner_errors_m), 0.02);
  EXPECT_LT(high(heading_errors_deg), 1.0);
  EXPECT_LT(high(wall_errors_m), 0.02);
  EXPECT_LT(high(wall_errors_deg), 1.0);
  RecordProperty("corner_95_m", std::to_string(high(corner_errors_m)));
  std::printf("corners %zu: 95 %% within %.4f m, %.2f deg; walls %zu: %.4f m, %.2f deg; error squared %.2f\n",
              corner_errors_m.size(), high(corner_errors_m), high(heading_errors_deg), wall_errors_m.size(),
              high(wall_errors_m), high(wall_errors_deg), squared / static_cast<double>(corner_errors_m.size()));
  EXPECT_NEAR(squared / static_cast<double>(corner_errors_m.size()), 1.0, 0.5);
}

TEST(ScanLines, TellTheCornerOfARoomFromOneThatStandsOut) {
  const auto corners = findCorners(findLines(seen(kRoom, 0.5, 0.002, 1), {}), {});
  int rooms = 0, pillars = 0;
  for (const ScanCorner& corner : corners) {
    const bool stands_out = (inRoom(corner.point_m, 0.5) - Eigen::Vector2d(1.0, 1.0)).norm() < 0.1;
    EXPECT_NEAR(corner.opening_rad / kDegree, stands_out ? 270.0 : 90.0, 1.0);
    ++(stands_out ? pillars : rooms);
  }
  EXPECT_EQ(pillars, 1);
  EXPECT_GE(rooms, 3);
}

TEST(ScanLines, ALongWallIsOneLineAndInvalidBeamsEndIt) {
  const Polygon corridor = {{-20.0, -1.0}, {20.0, -1.0}, {20.0, 1.0}, {-20.0, 1.0}};
  common::LaserScan scan = seen(corridor, 0.0, 0.02, 3);
  EXPECT_THAT(findLines(scan, {}), SizeIs(testing::Le(5U)));
  for (float& range : scan.ranges_m) range = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(findLines(scan, {}), testing::IsEmpty());
  scan.ranges_m.clear();
  EXPECT_THAT(findLines(scan, {}), testing::IsEmpty());
}

TEST(WallRecognizer, GivesEachWithItsFrame) {
  WallRecognizer recognizer({});
  const common::LaserScan scan = seen(kRoom, 0.0, 0.002, 2);
  const auto found = recognizer.recognize({nullptr, &scan});
  int corners = 0;
  for (const Recognized& one : found) {
    EXPECT_GT(one.confidence, 0.0);
    EXPECT_LE(one.confidence, 1.0);
    EXPECT_GT(one.covariance(2, 2), 0.0);
    EXPECT_EQ(one.covariance(5, 5), 0.0);
    if (one.what == "corner") {
      ++corners;
    } else {
      // Its x axis points from the wall to the laser's side.
      const Eigen::Vector3d towards = one.T_sensor_object.rotation * Eigen::Vector3d::UnitX();
      EXPECT_LT(towards.dot(one.T_sensor_object.position_m), 0.0);
    }
  }
  EXPECT_GE(corners, 3);
  EXPECT_THAT(recognizer.recognize({}), testing::IsEmpty());
}

}  // namespace
}  // namespace swiftlet::perception
