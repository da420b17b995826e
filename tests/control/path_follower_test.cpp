// Laws of the reference: continuous, within its limits, on its path, at its goal, whatever is changed in flight.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "common/random.hpp"
#include "control/path_follower.hpp"
#include "control/path_shape.hpp"

namespace swiftlet::control {
namespace {

using common::FlightMode;

constexpr double kDt_s = 0.01;

double distanceToPath(const Points& points, const Eigen::Vector3d& point) {
  const auto along = distancesAlong(points);
  return nearestOn(points, along, point, std::numeric_limits<double>::infinity()).off_m;
}

/// Follows a reference and records its greatest deviations.
struct Watch {
  PathFollower follower{PathFollower::Config{}};
  double worst_jump_m = 0, worst_speed_m_s = 0, worst_acceleration_m_s2 = 0, worst_yaw_rate = 0, seconds = 0;

  explicit Watch(const Eigen::Vector3d& start = Eigen::Vector3d::Zero()) { follower.reset(start, 0.0); }
  void step() {
    const Reference before = follower.reference();
    const Reference after = follower.advance(kDt_s);
    const Eigen::Vector3d moved = after.position_odom_m - before.position_odom_m;
    const Eigen::Vector3d mean = 0.5 * (before.velocity_odom_m_s + after.velocity_odom_m_s);
    worst_jump_m = std::max(worst_jump_m, (moved - kDt_s * mean).norm());
    worst_speed_m_s = std::max(worst_speed_m_s, after.velocity_odom_m_s.norm());
    worst_acceleration_m_s2 =
        std::max(worst_acceleration_m_s2, (after.velocity_odom_m_s - before.velocity_odom_m_s).norm() / kDt_s);
    worst_yaw_rate =
        std::max(worst_yaw_rate, std::abs(common::wrapAngle(after.yaw_odom_rad - before.yaw_odom_rad)) / kDt_s);
    seconds += kDt_s;
  }
  bool finish(double at_most_s = 60.0) {
    while (!follower.finished() && seconds < at_most_s) step();
    return follower.finished();
  }
};

TEST(PathFollower, KeepsThePaceOfItsPathUntilTheNext) {
  Watch watch;
  watch.follower.setPath({{0, 0, 0}, {10, 0, 0}}, FlightMode::kFast);
  watch.follower.setPace(0.4);
  for (int i = 0; i < 300; ++i) watch.step();
  EXPECT_NEAR(watch.follower.reference().velocity_odom_m_s.x(), 0.4, 1e-6);
  EXPECT_LE(watch.worst_speed_m_s, 0.4 + 1e-6);
  watch.follower.setPace(0.0);
  for (int i = 0; i < 300; ++i) watch.step();
  EXPECT_LT(watch.follower.reference().velocity_odom_m_s.norm(), 1e-3);
  EXPECT_TRUE(watch.follower.followsPath());
  EXPECT_LE(watch.worst_acceleration_m_s2, 1.5);
  watch.follower.setPath({watch.follower.reference().position_odom_m, {10, 0, 0}}, FlightMode::kFast);
  for (int i = 0; i < 300; ++i) watch.step();
  EXPECT_NEAR(watch.worst_speed_m_s, 1.0, 1e-3);
}

TEST(PathFollower, FacesAPointWhileItFliesPastAndWhileItHolds) {
  Watch watch;
  watch.follower.lookAt(Eigen::Vector2d(2.0, 1.5));
  for (int i = 0; i < 300; ++i) watch.step();
  watch.follower.setPath({{0, 0, 0}, {4, 0, 0}}, FlightMode::kAccurate);
  double worst_rad = 0.0;
  while (!watch.follower.finished() && watch.seconds < 60.0) {
    watch.step();
    const Eigen::Vector2d look = Eigen::Vector2d(2.0, 1.5) - watch.follower.reference().position_odom_m.head<2>();
    worst_rad =
        std::max(worst_rad,
                 std::abs(common::wrapAngle(std::atan2(look.y(), look.x()) - watch.follower.reference().yaw_odom_rad)));
  }
  EXPECT_TRUE(watch.follower.finished());
  EXPECT_LT(worst_rad, 0.02);
  EXPECT_LE(watch.worst_speed_m_s, 0.301) << "it does not wait for its nose";
  watch.follower.lookAt(std::nullopt);
  watch.follower.setPath({{4, 0, 0}, {0, 0, 0}}, FlightMode::kFast, std::nullopt, {{{4, 0}, 3.0}, {{0, 0}, 3.0}});
  for (int i = 0; i < 400; ++i) watch.step();
  EXPECT_NEAR(watch.follower.reference().yaw_odom_rad, 3.0, 0.02) << "as planned again";
}

TEST(PathFollower, AStraightLineHasATrapezoidalSpeedProfile) {
  Watch watch;
  watch.follower.setPath({{0, 0, 0}, {4, 0, 0}}, FlightMode::kFast);
  ASSERT_TRUE(watch.finish());
  EXPECT_EQ(watch.follower.reference().yaw_odom_rad, 0.0);
  EXPECT_NEAR((watch.follower.reference().position_odom_m - Eigen::Vector3d(4, 0, 0)).norm(), 0.0, 1e-3);
  EXPECT_LE(watch.worst_speed_m_s, 1.001);
  EXPECT_LE(watch.worst_acceleration_m_s2, 1.2 * 1.25);
  // 4 m at 1 m/s and 1.2 m/s^2 take 4.83 s; the rest is for the last millimetre.
  EXPECT_LT(watch.seconds, 5.6);
}

TEST(PathFollower, TheReferenceDoesNotLagOnAStraightLine) {
  Watch watch({0, 0, 1});
  watch.follower.setPath({{0, 0, 1}, {3, 3, 1}}, FlightMode::kFast);
  const double whole_m = watch.follower.remaining_m();
  double lag_m = 0;
  while (!watch.follower.finished() && watch.seconds < 60) {
    watch.step();
    const double carrot_m = whole_m - watch.follower.remaining_m();
    const double reference_m = (watch.follower.reference().position_odom_m - Eigen::Vector3d(0, 0, 1)).norm();
    lag_m = std::max(lag_m, std::abs(carrot_m - reference_m));
  }
  EXPECT_LT(lag_m, 0.005);
}

TEST(PathFollower, CornersAreRoundedWithinTheModesDeviation) {
  const Points corner = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}};
  for (const auto& [mode, deviation_m] :
       {std::pair(FlightMode::kFast, 0.08), std::pair(FlightMode::kCareful, 0.05),
        std::pair(FlightMode::kAccurate, 0.02), std::pair(FlightMode::kBrisk, 0.08)}) {
    Watch watch({0, 0, 0});
    watch.follower.setPath(corner, mode);
    double off_m = 0;
    while (!watch.follower.finished() && watch.seconds < 60) {
      watch.step();
      off_m = std::max(off_m, distanceToPath(corner, watch.follower.reference().position_odom_m));
    }
    ASSERT_TRUE(watch.follower.finished());
    EXPECT_LT(off_m, deviation_m + 0.01) << toString(mode);
    EXPECT_LT(watch.worst_acceleration_m_s2, 3.0) << toString(mode);
    std::printf("corner %s: %.3f m off, %.1f s, %.2f m/s^2\n", toString(mode), off_m, watch.seconds,
                watch.worst_acceleration_m_s2);
  }
}

TEST(PathFollower, ANewPathInFlightKeepsPositionAndSpeedContinuous) {
  Watch watch;
  watch.follower.setPath({{0, 0, 0}, {10, 0, 0}}, FlightMode::kFast);
  for (int i = 0; i < 250; ++i) watch.step();
  const Eigen::Vector3d here = watch.follower.reference().position_odom_m;
  ASSERT_NEAR(watch.follower.reference().velocity_odom_m_s.x(), 1.0, 1e-3);
  // The planner starts from its estimate of the vehicle: a few centimetres off.
  watch.follower.setPath({here + Eigen::Vector3d(-0.02, 0.02, 0), {5, 0.3, 0}, {10, 0, 0}}, FlightMode::kFast);
  watch.worst_acceleration_m_s2 = 0;
  for (int i = 0; i < 50; ++i) watch.step();
  EXPECT_GT(watch.follower.reference().velocity_odom_m_s.norm(), 0.9) << "it did not stop for it";
  EXPECT_LT(watch.worst_acceleration_m_s2, 2.5);
  ASSERT_TRUE(watch.finish());
  EXPECT_LT(watch.worst_jump_m, 2e-4);
}

TEST(PathFollower, TurningBackAtSpeedBrakesFirst) {
  Watch watch;
  watch.follower.setPath({{0, 0, 0}, {10, 0, 0}}, FlightMode::kFast);
  for (int i = 0; i < 300; ++i) watch.step();
  const double x = watch.follower.reference().position_odom_m.x();
  watch.follower.setPath({{x, 0, 0}, {0, 0, 0}}, FlightMode::kFast);
  double farthest_m = x;
  while (!watch.follower.finished() && watch.seconds < 60) {
    watch.step();
    farthest_m = std::max(farthest_m, watch.follower.reference().position_odom_m.x());
  }
  EXPECT_TRUE(watch.follower.finished());
  EXPECT_LT(farthest_m - x, 1.0 / (2 * 1.2) + 0.1);
  EXPECT_LT(watch.worst_acceleration_m_s2, 3.0);
}

TEST(PathFollower, StopTakesTheBrakingDistance) {
  Watch watch;
  watch.follower.setPath({{0, 0, 0}, {10, 0, 0}}, FlightMode::kCareful);
  for (int i = 0; i < 300; ++i) watch.step();
  const Eigen::Vector3d from = watch.follower.reference().position_odom_m;
  watch.follower.stop();
  ASSERT_TRUE(watch.finish());
  EXPECT_NEAR((watch.follower.reference().position_odom_m - from).norm(), 0.36 / (2 * 0.8), 0.02);
  EXPECT_LT(watch.worst_acceleration_m_s2, 1.3);
}

TEST(PathFollower, ASpeedLimitTakesEffectWithinTheBrakingTime) {
  Watch watch;
  watch.follower.setPath({{0, 0, 0}, {20, 0, 0}}, FlightMode::kFast);
  for (int i = 0; i < 300; ++i) watch.step();
  watch.follower.setSpeedLimit(0.25);
  for (int i = 0; i < 70; ++i) watch.step();  // 0.75 m/s at 1.2 m/s^2: 0.63 s.
  EXPECT_NEAR(watch.follower.reference().velocity_odom_m_s.norm(), 0.25, 0.02);
  watch.follower.setSpeedLimit(std::numeric_limits<double>::quiet_NaN());
  for (int i = 0; i < 60; ++i) watch.step();
  EXPECT_LT(watch.follower.reference().velocity_odom_m_s.norm(), 0.02) << "what is not a number is no permission";
  EXPECT_FALSE(watch.follower.finished());
  watch.follower.setSpeedLimit(std::numeric_limits<double>::infinity());
  EXPECT_TRUE(watch.finish());
}

/// Facings from a yaw to another, evenly along a straight path in the plane.
std::vector<common::Facing> evenly(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double yaw_rad,
                                   double end_yaw_rad, double speed_m_s = std::numeric_limits<double>::infinity()) {
  constexpr int kStretches = 20;
  std::vector<common::Facing> facings;
  for (int i = 0; i <= kStretches; ++i) {
    const double share = static_cast<double>(i) / kStretches;
    facings.push_back({from + share * (to - from), yaw_rad + share * (end_yaw_rad - yaw_rad), speed_m_s});
  }
  return facings;
}

TEST(PathFollower, FliesTheYawThatWasPlannedAlongItsPath) {
  Watch watch;
  watch.follower.setPath({{0, 0, 0}, {0, 4, 0}}, FlightMode::kFast, 1.2, evenly({0, 0}, {0, 4}, 0.0, 1.2));
  double worst_rad = 0.0;
  while (!watch.follower.finished() && watch.seconds < 60) {
    watch.step();
    const Reference& reference = watch.follower.reference();
    // The nose leads by a stretch, 0.2 m.
    const double planned_rad = std::min(1.2, (reference.position_odom_m.y() + 0.2) / 4.0 * 1.2);
    worst_rad = std::max(worst_rad, std::abs(reference.yaw_odom_rad - planned_rad));
  }
  EXPECT_TRUE(watch.follower.finished());
  EXPECT_LT(worst_rad, 0.07);
  EXPECT_NEAR(watch.follower.reference().yaw_odom_rad, 1.2, 0.01);
  EXPECT_LE(watch.worst_yaw_rate * 180 / std::numbers::pi, 60.1);
  watch.seconds = 0;
  watch.follower.setPath({{0, 4, 0}, {-3, 4, 0}}, FlightMode::kFast);
  ASSERT_TRUE(watch.finish());
  EXPECT_NEAR(watch.follower.reference().yaw_odom_rad, 1.2, 0.02) << "nothing is planned: it stays";
}

TEST(PathFollower, WaitsForItsNoseWhereThatWasPlanned) {
  Watch watch;
  std::vector<common::Facing> facings = evenly({0, 0}, {-4, 0}, -3.1, -3.1);
  facings.front().yaw_rad = 0.0;
  facings.front().speed_m_s = 0.05;  // 0.2 m in 4 s, in which the nose turns round.
  watch.follower.setPath({{0, 0, 0}, {-4, 0, 0}}, FlightMode::kFast, std::nullopt, facings);
  while (std::abs(watch.follower.reference().yaw_odom_rad) < 2.8 && watch.seconds < 10) {
    watch.step();
    EXPECT_LT(watch.follower.reference().velocity_odom_m_s.norm(), 0.2);
  }
  EXPECT_LT(watch.follower.reference().position_odom_m.norm(), 0.3);
  EXPECT_TRUE(watch.finish());
}

TEST(PathFollower, ANoseThatFacedSomethingElseIsWaitedFor) {
  Watch watch;
  watch.follower.lookAt(Eigen::Vector2d(-100, -1));
  for (int i = 0; i < 400; ++i) watch.step();
  watch.follower.setPath({{0, 0, 0}, {6, 0, 0}}, FlightMode::kFast, std::nullopt, evenly({0, 0}, {6, 0}, 0.0, 0.0));
  for (int i = 0; i < 200; ++i) watch.step();
  EXPECT_GT(watch.follower.reference().velocity_odom_m_s.norm(), 0.9) << "not while it faces a point";
  watch.follower.lookAt(std::nullopt);
  for (int i = 0; i < 150; ++i) watch.step();
  EXPECT_LT(watch.follower.reference().velocity_odom_m_s.norm(), 0.25);
  EXPECT_TRUE(watch.finish());
  EXPECT_NEAR(watch.follower.reference().yaw_odom_rad, 0.0, 0.02);
}

TEST(PathFollower, AClimbDoesNotWaitForTheNose) {
  Watch watch;
  std::vector<common::Facing> facings = evenly({0, 0}, {-4, 0}, 2.5, 2.5);
  facings.front() = {{0, 0}, 0.0, 0.06};
  watch.follower.setPath({{0, 0, 1}, {0, 0, 2}, {-4, 0, 2}}, FlightMode::kFast, std::nullopt, facings);
  for (int i = 0; i < 400; ++i) watch.step();
  EXPECT_GT(watch.follower.reference().position_odom_m.z(), 1.8);
  EXPECT_NEAR(watch.follower.reference().yaw_odom_rad, 2.5, 0.02);
}

TEST(PathFollower, TheNoseTurnsAlthoughTheVehicleIsHeldUp) {
  Watch watch;
  std::vector<common::Facing> facings = evenly({0, 0}, {-4, 0}, 2.5, 2.5);
  facings.front() = {{0, 0}, 0.0, 0.06};
  watch.follower.setPath({{0, 0, 0}, {-4, 0, 0}}, FlightMode::kFast, std::nullopt, facings);
  watch.follower.setSpeedLimit(0.0);  // The reactive layer does not see where it would fly.
  for (int i = 0; i < 400; ++i) watch.step();
  EXPECT_NEAR(watch.follower.reference().yaw_odom_rad, 2.5, 0.02);
}

TEST(PathFollower, AMapCorrectionMovesThePathButNotTheReference) {
  Watch watch;
  watch.follower.setPath({{0, 0, 0}, {10, 0, 0}}, FlightMode::kFast);
  for (int i = 0; i < 300; ++i) watch.step();
  watch.follower.movePath({0.1, -0.2, 0.03});
  watch.worst_jump_m = 0;
  ASSERT_TRUE(watch.finish());
  EXPECT_LT(watch.worst_jump_m, 6e-4);
  const Eigen::Vector2d goal = common::Pose2{0.1, -0.2, 0.03} * Eigen::Vector2d(10, 0);
  EXPECT_LT((watch.follower.reference().position_odom_m.head<2>() - goal).norm(), 2e-3);
}

/// Things that stand, and how near to them the middle of a hull comes.
struct Things {
  Points things;
  double at_m(const Eigen::Vector3d& place) const {
    double least_m = std::numeric_limits<double>::infinity();
    for (const auto& thing : things) least_m = std::min(least_m, (thing - place).norm());
    return least_m;
  }
  common::ClearanceAlong along(double enough_m) const {
    return [this, enough_m](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
      double least_m = enough_m;
      for (const auto& thing : things) {
        const double share =
            std::clamp((thing - from).dot(to - from) / std::max(1e-12, (to - from).squaredNorm()), 0.0, 1.0);
        least_m = std::min(least_m, (from + share * (to - from) - thing).norm());
      }
      return least_m;
    };
  }
};

/// Flies at 1 m/s along x when the path turns away at a right angle. Returns how near it came to a thing.
double leastInTurn_m(const Things& things, bool asks, double& seconds) {
  Watch watch;
  watch.follower.setPath({{0, 0, 0}, {10, 0, 0}}, FlightMode::kFast);
  for (int i = 0; i < 300; ++i) watch.step();
  const Eigen::Vector3d here = watch.follower.reference().position_odom_m;
  Things moved = things;
  for (auto& thing : moved.things) thing += here;
  watch.seconds = 0.0;
  watch.worst_jump_m = 0.0;
  watch.follower.setPath({here, here + Eigen::Vector3d(0, 3, 0)}, FlightMode::kFast, std::nullopt, {},
                         asks ? moved.along(0.325) : common::ClearanceAlong());
  double least_m = std::numeric_limits<double>::infinity();
  while (!watch.follower.finished() && watch.seconds < 60.0) {
    watch.step();
    least_m = std::min(least_m, moved.at_m(watch.follower.reference().position_odom_m));
  }
  EXPECT_TRUE(watch.follower.finished());
  EXPECT_LT(watch.worst_jump_m, 1e-3);
  EXPECT_LT(watch.worst_acceleration_m_s2, 3.3);
  seconds = watch.seconds;
  return least_m;
}

TEST(PathFollower, CutsACornerOnlyWhereNothingStands) {
  double free_s = 0.0, braked_s = 0.0, unasked_s = 0.0;
  // Far away: the turn is flown at speed, as without asking.
  leastInTurn_m({{{3, 3, 0}}}, true, free_s);
  leastInTurn_m({{{3, 3, 0}}}, false, unasked_s);
  EXPECT_EQ(free_s, unasked_s);
  // In the cut, and clear of the path and of the braking distance.
  const Things thing{{{0.33, 0.45, 0}}};
  const double unasked_m = leastInTurn_m(thing, false, unasked_s), asked_m = leastInTurn_m(thing, true, braked_s);
  std::printf("a corner that is not free: %.3f m in %.1f s, asked %.3f m in %.1f s\n", unasked_m, unasked_s, asked_m,
              braked_s);
  EXPECT_LT(unasked_m, 0.275) << "the hull touches what nobody asked for";
  EXPECT_GT(asked_m, 0.30);
  EXPECT_GT(braked_s, free_s);
  EXPECT_LT(braked_s, free_s + 4.0);
}

TEST(PathFollower, JoinsAtTheNearestPlaceWhereTheLineAheadIsNotFree) {
  // It stands 0.8 m beside a path that leads past something between the two.
  const Things thing{{{0.5, 0.45, 0}}};
  for (const bool asks : {false, true}) {
    Watch watch({0, 0.8, 0});
    watch.follower.setPath({{0, 0, 0}, {3, 0, 0}}, FlightMode::kCareful, std::nullopt, {},
                           asks ? thing.along(0.325) : common::ClearanceAlong());
    double least_m = 10.0;
    while (!watch.follower.finished() && watch.seconds < 60.0) {
      watch.step();
      least_m = std::min(least_m, thing.at_m(watch.follower.reference().position_odom_m));
    }
    EXPECT_TRUE(watch.follower.finished());
    EXPECT_EQ(least_m > 0.275, asks) << least_m;
  }
}

TEST(PathFollower, NeverComesNearerForAsking) {
  rc::check([] {
    common::RandomStream random(static_cast<std::uint64_t>(*rc::gen::inRange(1, 1'000'000)), "cut corners");
    Things things;
    for (int i = 0; i < 3; ++i) things.things.push_back({random.uniform(-1, 1.5), random.uniform(-1.5, 1.5), 0});
    const double turn_rad = random.uniform(-3.1, 3.1);
    const auto room_m = [&](bool asks) {
      Watch watch({-2, 0, 0});
      watch.follower.setPath({{-2, 0, 0}, {5, 0, 0}}, FlightMode::kFast);
      while (watch.follower.reference().position_odom_m.x() < 0.0) watch.step();
      const Eigen::Vector3d here = watch.follower.reference().position_odom_m;
      watch.follower.setPath({here, here + 3.0 * Eigen::Vector3d(std::cos(turn_rad), std::sin(turn_rad), 0)},
                             FlightMode::kFast, std::nullopt, {},
                             asks ? things.along(0.325) : common::ClearanceAlong());
      double least_m = 0.325;
      while (!watch.follower.finished() && watch.seconds < 60.0) {
        watch.step();
        least_m = std::min(least_m, things.at_m(watch.follower.reference().position_odom_m));
      }
      RC_ASSERT(watch.follower.finished());
      return least_m;
    };
    // A corner is rounded within its mode's deviation, and the reference keeps to its lines within 2 cm.
    RC_ASSERT(room_m(true) > room_m(false) - 0.05);
  });
}

TEST(PathFollower, RandomPathsAtRandomTimesStayContinuousAndEndAtTheGoal) {
  rc::check([] {
    const auto seed = *rc::gen::inRange(1, 1'000'000);
    common::RandomStream random(static_cast<std::uint64_t>(seed), "paths");
    Watch watch;
    Points path;
    for (int replan = 0; replan < 6; ++replan) {
      path = {watch.follower.reference().position_odom_m +
              Eigen::Vector3d(random.gaussian(0.03), random.gaussian(0.03), random.gaussian(0.02))};
      const int n = 1 + static_cast<int>(random.uniform(0, 8));
      for (int i = 0; i < n; ++i)
        path.push_back(path.back() + Eigen::Vector3d(random.gaussian(0.8), random.gaussian(0.8), random.gaussian(0.1)));
      watch.follower.setPath(path, static_cast<FlightMode>(static_cast<int>(random.uniform(0, 3))));
      if (random.chance(0.3)) watch.follower.setSpeedLimit(random.uniform(0.2, 1.0));
      for (int i = 0; i < static_cast<int>(random.uniform(10, 300)); ++i) watch.step();
    }
    RC_ASSERT(watch.finish(200.0));
    RC_ASSERT((watch.follower.reference().position_odom_m - path.back()).norm() < 2e-3);
    RC_ASSERT(watch.worst_jump_m < 1e-3);
    RC_ASSERT(watch.worst_speed_m_s < 1.35);
    RC_ASSERT(watch.worst_acceleration_m_s2 < 8.0);
  });
}

TEST(PathShape, SimplifyingStaysWithinTheTolerance) {
  rc::check([] {
    common::RandomStream random(static_cast<std::uint64_t>(*rc::gen::inRange(1, 1'000'000)), "simplify");
    Points points{{0, 0, 0}};
    for (int i = 0; i < 60; ++i)
      points.push_back(points.back() + Eigen::Vector3d(random.uniform(0, 0.1), random.gaussian(0.02), 0));
    const Points fewer = simplified(points, 0.02);
    RC_ASSERT(fewer.front() == points.front());
    RC_ASSERT(fewer.back() == points.back());
    for (const auto& point : points) RC_ASSERT(distanceToPath(fewer, point) <= 0.02 + 1e-9);
  });
}

TEST(PathShape, SpeedsAllowBrakingForTheNextPoint) {
  const Points points = rounded({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1.1, 1, 0}, {1.1, 0, 0}}, 0.05);
  const auto speeds = speedsAlong(points, {1.0, 1.0, 0.5, 0.12});
  const auto along = distancesAlong(points);
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    EXPECT_LE(speeds[i] * speeds[i], speeds[i + 1] * speeds[i + 1] + 2.0 * (along[i + 1] - along[i]) + 1e-9);
  EXPECT_EQ(speeds.back(), 0.0);
}

TEST(PathFollower, FollowsAVelocityCommandAndItsReversalAtOnce) {
  Watch watch({1, 2, 1});
  watch.follower.setVelocity({0.6, 0.0, 0.0}, 1.0, 0.4);
  for (int i = 0; i < 80; ++i) watch.step();
  EXPECT_NEAR((watch.follower.reference().velocity_odom_m_s - Eigen::Vector3d(0.6, 0, 0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR(watch.follower.reference().yaw_odom_rad, 0.4, 0.15);
  const double x_m = watch.follower.reference().position_odom_m.x();
  watch.follower.setVelocity({-0.6, 0.0, 0.0}, 1.0, 0.4);
  for (int i = 0; i < 120; ++i) watch.step();
  EXPECT_NEAR(watch.follower.reference().velocity_odom_m_s.x(), -0.6, 1e-6);
  EXPECT_NEAR(watch.follower.reference().position_odom_m.x(), x_m, 1e-6) << "0.18 m on and back";
  EXPECT_NEAR(watch.follower.reference().position_odom_m.y(), 2.0, 1e-9);
  EXPECT_LE(watch.worst_acceleration_m_s2, 1.0 + 1e-6);
  EXPECT_LE(watch.worst_jump_m, 1e-6);
}

TEST(PathFollower, SwitchesSmoothlyBetweenPathAndVelocity) {
  Watch watch({0, 0, 1});
  watch.follower.setPath({{0, 0, 1}, {5, 0, 1}}, FlightMode::kFast);
  for (int i = 0; i < 150; ++i) watch.step();
  watch.follower.setVelocity({0.0, 0.7, 0.0}, 1.0, 0.0);
  for (int i = 0; i < 150; ++i) watch.step();
  EXPECT_FALSE(watch.follower.finished());
  watch.follower.movePath({0.3, -0.2, 0.5});
  for (int i = 0; i < 100; ++i) watch.step();
  const Eigen::Vector3d& velocity = watch.follower.reference().velocity_odom_m_s;
  EXPECT_NEAR(std::atan2(velocity.y(), velocity.x()), 0.5 * std::numbers::pi + 0.5, 1e-3) << "turned with the frame";
  watch.follower.setPath({watch.follower.reference().position_odom_m, {8, 3, 1}}, FlightMode::kFast);
  ASSERT_TRUE(watch.finish());
  watch.follower.setVelocity({0.5, 0.0, 0.0}, 1.0, 0.0);
  for (int i = 0; i < 60; ++i) watch.step();
  watch.follower.stop();
  ASSERT_TRUE(watch.finish());
  EXPECT_LE(watch.worst_jump_m, 1e-4);
  EXPECT_LE(watch.worst_acceleration_m_s2, 3.5);
}

}  // namespace
}  // namespace swiftlet::control
