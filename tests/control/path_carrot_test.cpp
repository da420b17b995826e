// The carrot's speed profile, and the nose that follows it.
#include "control/path_carrot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "control/yaw_reference.hpp"

namespace swiftlet::control {
namespace {

constexpr double kCarrotDt_s = 0.01;
constexpr double kFree = std::numeric_limits<double>::infinity();

TEST(PathCarrot, SpeedsUpAndBrakesWithinItsAccelerationsAndEndsAtTheGoal) {
  PathCarrot carrot;
  carrot.lay({{0, 0, 1}, {2, 0, 1}}, {1.0, 0.8, 0.5, 0.12}, 0.96);
  double before_m_s = 0.0, fastest_m_s = 0.0;
  for (int i = 0; i < 1000 && carrot.remaining_m() > 0.0; ++i) {
    const Carrot now = carrot.advance(kCarrotDt_s, 1.0);
    const double speed_m_s = now.velocity_odom_m_s.x();
    EXPECT_LE(speed_m_s - before_m_s, 0.8 * kCarrotDt_s + 1e-9);
    const bool ended = carrot.remaining_m() <= 0.0;
    EXPECT_TRUE(ended || speed_m_s - before_m_s >= -0.96 * kCarrotDt_s - 1e-9)
        << "braking from " << before_m_s << " m/s";
    fastest_m_s = std::max(fastest_m_s, before_m_s = speed_m_s);
  }
  EXPECT_EQ(carrot.remaining_m(), 0.0);
  EXPECT_NEAR(fastest_m_s, 1.0, 1e-9);
  EXPECT_EQ(carrot.advance(kCarrotDt_s, 1.0).position_odom_m, carrot.goal());
}

TEST(PathCarrot, ALowerCapBrakesIt) {
  PathCarrot carrot;
  carrot.lay({{0, 0, 1}, {9, 0, 1}}, {1.0, 1.0, 0.5, 0.12}, 1.2);
  carrot.setSpeed(1.0);
  int ticks = 0;
  while (carrot.advance(kCarrotDt_s, 0.4).velocity_odom_m_s.x() > 0.4) ++ticks;
  EXPECT_NEAR(ticks * kCarrotDt_s, 0.6 / 1.2, 0.02);
}

TEST(PathCarrot, APointIsItsOwnGoal) {
  PathCarrot carrot;
  carrot.lay({{1, 2, 3}}, {1.0, 1.0, 0.5, 0.12}, 1.2);
  EXPECT_TRUE(carrot.line_m().isZero());
  EXPECT_EQ(carrot.advance(kCarrotDt_s, kFree).position_odom_m, Eigen::Vector3d(1, 2, 3));
  carrot.move({1.0, 0.0, 0.0});
  EXPECT_EQ(carrot.goal(), Eigen::Vector3d(2, 2, 3));
}

TEST(VelocityCarrot, ReversesAlongAStraightLine) {
  VelocityCarrot carrot({{0, 0, 1}, {0.5, 0, 0}, {0, 0, 0}});
  carrot.setTarget({-0.5, 0, 0}, 1.0);
  Carrot now;
  for (int i = 0; i < 50; ++i) now = carrot.advance(kCarrotDt_s);
  EXPECT_NEAR(now.velocity_odom_m_s.x(), 0.0, 1e-9);
  EXPECT_NEAR(now.position_odom_m.x(), 0.5 * 0.5 * 0.5, 1e-9);
  for (int i = 0; i < 100; ++i) now = carrot.advance(kCarrotDt_s);
  EXPECT_NEAR(now.velocity_odom_m_s.x(), -0.5, 1e-9);
  carrot.turn(M_PI / 2.0);
  for (int i = 0; i < 200; ++i) now = carrot.advance(kCarrotDt_s);
  EXPECT_NEAR(now.velocity_odom_m_s.y(), -0.5, 1e-9);
}

/// The yaw after three seconds of turning from zero, within its rate and acceleration.
double yawAfter(YawReference& yaw, const std::optional<PlannedYaw>& planned, bool looks) {
  Reference reference;
  for (int i = 0; i < 300; ++i) {
    const double before_rad_s = reference.yaw_rate_rad_s;
    yaw.advance(reference, planned, looks, kCarrotDt_s);
    EXPECT_LE(std::abs(reference.yaw_rate_rad_s), 60.0 * common::kRadPerDeg + 1e-9);
    EXPECT_LE(std::abs(reference.yaw_rate_rad_s - before_rad_s), 1.2 * 180.0 * common::kRadPerDeg * kCarrotDt_s + 1e-9);
  }
  return reference.yaw_odom_rad;
}

TEST(YawReference, FacesAPointThenWhatIsPlannedThenTheGoal) {
  YawReference yaw(60.0);
  yaw.setGoal(0.4);
  EXPECT_NEAR(yawAfter(yaw, PlannedYaw{M_PI / 2.0, 0.0}, true), M_PI / 2.0, 1e-6);
  EXPECT_NEAR(yawAfter(yaw, std::nullopt, true), 0.4, 1e-6);
  EXPECT_FALSE(yaw.facesPoint());
  yaw.lookAt(Eigen::Vector2d(1, -1));
  EXPECT_TRUE(yaw.facesPoint());
  EXPECT_NEAR(yawAfter(yaw, PlannedYaw{M_PI / 2.0, 0.0}, true), -M_PI / 4.0, 1e-6);
  EXPECT_NEAR(yawAfter(yaw, std::nullopt, false), 0.4, 1e-6) << "a velocity has a yaw of its own";
}

TEST(YawReference, ItsGoalTurnsWithTheMap) {
  YawReference yaw(60.0);
  yaw.setGoal(0.4);
  yaw.turn(0.2);
  EXPECT_FALSE(yaw.reached(0.4));
  EXPECT_TRUE(yaw.reached(0.6));
  yaw.hold(1.0);
  EXPECT_TRUE(yaw.reached(0.0)) << "without a goal every yaw is reached";
  EXPECT_NEAR(yawAfter(yaw, std::nullopt, true), 1.0, 1e-6);
}

}  // namespace
}  // namespace swiftlet::control
