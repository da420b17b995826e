// The frame that a vehicle with a turned laser can know.
#include "evaluation/knowable_frame.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "evaluation/flight_recorder.hpp"
#include "simulation/sensors/laser_scanner.hpp"
#include "small_world.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Pose3;
using common::Time;

constexpr double kMountYaw_deg = 1.0;
const double kMountYaw_rad = kMountYaw_deg * common::kRadPerDeg;
const Pose3 kStart{common::quaternionFrom({0, 0, M_PI_2}), {1, 1, 0}};

simulation::LaserErrorsConfig turnedLaser() {
  simulation::LaserErrorsConfig errors;
  errors.mount_error.yaw_deg = kMountYaw_deg;
  return errors;
}

Pose3 turned(double yaw_rad) { return common::lifted({0.0, 0.0, yaw_rad}, 0.0); }

/// Greatest distance of a scan's end points from the walls of the room, when they are drawn from the pose `T_map_body`
/// in a map that lies at `T_world_map`, by a vehicle that believes the data sheet.
double worstEndPoint_m(const Pose3& T_world_body, const Pose3& T_world_map, const Pose3& T_map_body) {
  common::LaserConfig sheet;
  sheet.range_noise_m = sheet.dropout_rate = 0.0;
  sheet.mount.x_m = 0.05;
  const simulation::WorldModel world = smallWorld(1.0F);
  const simulation::RayCaster rays(world);
  simulation::LaserScanner scanner(sheet, turnedLaser(), world, 1);
  const Time end = Time() + scanner.sweep();
  const common::LaserScan scan = scanner.scan(0, Time(), {{Time(), T_world_body, {}}, {end, T_world_body, {}}}, rays);
  double worst_m = 0.0;
  for (int beam = 0; beam < sheet.beams; ++beam) {
    if (sheet.isMirrorBeam(beam)) continue;
    const double range_m = scan.ranges_m[static_cast<std::size_t>(beam)];
    const Eigen::Vector3d point = T_world_map * (T_map_body * (sheet.mount.pose() * (range_m * sheet.direction(beam))));
    const double to_outer_m =
        std::min({std::abs(point.x()), std::abs(point.x() - 4.0), std::abs(point.y()), std::abs(point.y() - 3.0)});
    worst_m = std::max(worst_m, std::min(to_outer_m, std::abs(point.x() - 2.0)));
  }
  return worst_m;
}

TEST(KnowableFrame, PutsEachEndPointOfATurnedLaserOnItsWall) {
  const Pose3 T_world_map = knowableFrame(kStart, turnedLaser());
  for (const double yaw_rad : {0.0, 0.7, -2.0}) {
    const Pose3 T_world_body{common::quaternionFrom({0, 0, yaw_rad}), {1.4, 2.0, 1.0}};
    const Pose3 T_map_body = T_world_map.inverse() * T_world_body * turned(kMountYaw_rad);
    EXPECT_LT(worstEndPoint_m(T_world_body, T_world_map, T_map_body), 2e-3);
    EXPECT_GT(worstEndPoint_m(T_world_body, kStart, T_map_body), 8e-3) << "in the raw frame the room is turned";
  }
}

TEST(KnowableFrame, IsTheRawFrameWithoutAnErrorOfTheMountsYaw) {
  simulation::LaserErrorsConfig errors;
  errors.mount_error.x_m = 0.01;
  const Pose3 frame = knowableFrame(kStart, errors);
  EXPECT_TRUE(frame.position_m.isApprox(kStart.position_m));
  EXPECT_NEAR(frame.rotation.angularDistance(kStart.rotation), 0.0, 1e-12);
}

/// A vehicle whose laser alone is wrong, and by its yaw alone, makes no error that it could know.
TEST(KnowableFrame, ATurnedMapIsNoErrorOfTheEstimateButOneOfTheRawFrame) {
  FlightRecorder recorder(kStart, knowableFrame(kStart, turnedLaser()));
  for (int i = 0; i <= 10; ++i) {
    const Pose3 T_start_body = common::lifted({0.5 * i, 0.1 * i, 0.3 * i}, 1.0);
    simulation::Truth truth;
    truth.stamp = Time::fromSeconds(0.1 * i);
    truth.T_world_body = kStart * T_start_body;
    truth.airborne = true;
    common::VehicleState state;
    state.stamp = truth.stamp;
    state.T_odom_body = turned(-kMountYaw_rad) * T_start_body * turned(kMountYaw_rad);
    recorder.tick(truth, state);
    const Eigen::Vector2d there_m = state.T_odom_body.position_m.head<2>();
    recorder.intent(truth.stamp, {7, common::GoToIntent{there_m, {}, {}, 0.05, 0.1}},
                    {7, i == 10 ? common::IntentState::kSucceeded : common::IntentState::kRunning, "", true});
  }
  const FlightRecord record = recorder.finish();
  const double far_m = std::hypot(5.0, 1.0), turned_m = 2.0 * std::sin(0.5 * kMountYaw_rad) * far_m;
  EXPECT_NEAR(record.estimate.horizontal_errors_m.back(), 0.0, 1e-9);
  EXPECT_NEAR(record.estimate.horizontal_errors_raw_m.back(), turned_m, 1e-9);
  EXPECT_NEAR(record.estimate.yaw_errors_rad.back(), 0.0, 1e-9);
  ASSERT_EQ(record.goals.size(), 1u);
  EXPECT_NEAR(record.goals[0].error_m, 0.0, 1e-9);
  EXPECT_NEAR(record.goals[0].error_raw_m, turned_m, 1e-9);
}

/// A fit of the whole flight would find the drift to be a turn of the frame.
TEST(KnowableFrame, DoesNotHideDriftOfTheHeading) {
  FlightRecorder recorder(kStart, knowableFrame(kStart, {}));
  for (int i = 0; i <= 10; ++i) {
    simulation::Truth truth;
    truth.stamp = Time::fromSeconds(0.1 * i);
    truth.T_world_body = kStart * common::lifted({0.5 * i, 0.0, 0.0}, 1.0);
    truth.airborne = true;
    common::VehicleState state;
    state.stamp = truth.stamp;
    state.T_odom_body = turned(kMountYaw_rad) * common::lifted({0.5 * i, 0.0, 0.0}, 1.0);
    recorder.tick(truth, state);
  }
  EXPECT_NEAR(recorder.finish().estimate.horizontal_errors_m.back(), 5.0 * 2.0 * std::sin(0.5 * kMountYaw_rad), 1e-9);
}

}  // namespace
}  // namespace swiftlet::evaluation
