#include "perception/projection/placed_returns.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace swiftlet::perception {
namespace {

using common::Pose3;
using common::Time;

common::LaserConfig upright() {
  common::LaserConfig laser;
  laser.mount = {.x_m = -0.06, .z_m = -0.05, .pitch_deg = 90.0};
  return laser;
}

/// Turns, flies and sways at once, fast enough that a sweep placed as a whole would be wrong by centimetres.
Pose3 swaying(Time time) {
  const double t = time.seconds();
  return {common::quaternionFrom({0.05 * std::sin(9.0 * t), 0.08 * std::cos(7.0 * t), 0.3 + 2.0 * t}),
          {0.4 + 1.0 * t, -0.2 + 0.7 * t, 1.0 + 0.2 * t}};
}

common::LaserScan sweepOf(const common::LaserConfig& laser, float range_m) {
  common::LaserScan scan;
  scan.stamps.measured = Time::fromSeconds(0.37);
  scan.time_increment = common::Duration::fromNanoseconds(17'361);
  scan.angle_min_rad = laser.angleMin_rad();
  scan.angle_increment_rad = laser.angleIncrement_rad();
  scan.range_min_m = laser.range_min_m;
  scan.range_max_m = laser.range_max_m;
  scan.ranges_m.assign(static_cast<std::size_t>(laser.beams), range_m);
  return scan;
}

TEST(PlacedReturns, EachBeamHasThePoseOfItsOwnTime) {
  const common::LaserConfig laser = upright();
  const common::LaserScan scan = sweepOf(laser, 4.0F);
  const std::vector<PlacedReturn> returns = placeReturns(scan, laser, swaying, 0.3);
  ASSERT_EQ(returns.size(), 1081U);
  double moved_m = 0.0;
  for (int beam = 0; beam < laser.beams; ++beam) {
    const Pose3 T_odom_laser = swaying(scan.stamps.measured + scan.time_increment * beam) * laser.mount.pose();
    const PlacedReturn& placed = returns[static_cast<std::size_t>(beam)];
    EXPECT_LT((placed.origin_m - T_odom_laser.position_m).norm(), 1e-9);
    EXPECT_LT((placed.end_m - T_odom_laser * Eigen::Vector3d(4.0 * laser.direction(beam))).norm(), 1e-9);
    const Eigen::Vector3d at_once =
        swaying(scan.stamps.measured) * laser.mount.pose() * Eigen::Vector3d(4.0 * laser.direction(beam));
    moved_m = std::max(moved_m, (placed.end_m - at_once).norm());
  }
  EXPECT_GT(moved_m, 0.05) << "the motion within the sweep is taken out";
}

TEST(PlacedReturns, TheScanPlaneStandsUpright) {
  const common::LaserConfig laser = upright();
  const auto still = [](Time) { return Pose3{Eigen::Quaterniond::Identity(), {1.0, 2.0, 3.0}}; };
  const std::vector<PlacedReturn> returns = placeReturns(sweepOf(laser, 2.0F), laser, still, 0.0);
  ASSERT_EQ(returns.size(), 1081U);
  for (const PlacedReturn& placed : returns) EXPECT_NEAR(placed.end_m.x(), 0.94, 1e-9);
  EXPECT_NEAR(returns[540].end_m.z(), 0.95, 1e-9) << "the middle of the fan looks down";
}

TEST(PlacedReturns, BeamsWithoutAUsableRangeAreLeftOut) {
  const common::LaserConfig laser = upright();
  common::LaserScan scan = sweepOf(laser, 4.0F);
  scan.ranges_m[1] = std::numeric_limits<float>::quiet_NaN();
  scan.ranges_m[2] = std::numeric_limits<float>::infinity();
  scan.ranges_m[3] = 30.5F;
  scan.ranges_m[4] = 0.0F;
  scan.ranges_m[5] = -1.0F;
  scan.ranges_m[6] = 0.05F;
  scan.ranges_m[7] = 0.2F;  // On the vehicle.
  const std::vector<PlacedReturn> returns = placeReturns(scan, laser, swaying, 0.3);
  EXPECT_EQ(returns.size(), 1081U - 7U);
  for (const PlacedReturn& placed : returns) EXPECT_NEAR((placed.end_m - placed.origin_m).norm(), 4.0, 1e-6);
  scan.ranges_m.clear();
  EXPECT_TRUE(placeReturns(scan, laser, swaying, 0.3).empty());
}

}  // namespace
}  // namespace swiftlet::perception
