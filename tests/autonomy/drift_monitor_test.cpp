// The uncertainty of the position, scan by scan.
#include "autonomy/estimation/drift_monitor.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

class Drift : public testing::Test {
 protected:
  /// A scan 0.1 s after the last one.
  double scan(double variance_x_m2, bool matched, bool sees_x, bool new_reference = false) {
    time_s_ += 0.1;
    PositionFix fix{
        common::Time::fromSeconds(time_s_), Eigen::Matrix2d::Zero(), matched, {}, new_reference, key_, known_key_};
    fix.covariance_odom_m2(0, 0) = variance_x_m2;
    fix.covariance_odom_m2(1, 1) = 7.0;  // It does not grow.
    if (matched && !sees_x) fix.unobservable_direction_odom = Eigen::Vector2d::UnitX();
    fix.turns = turns_;
    return monitor_.add(fix);
  }
  /// `count` scans that see every direction; returns the drift after them.
  double see(int count, double variance_x_m2) {
    double drift_m = 0.0;
    for (int i = 0; i < count; ++i) drift_m = scan(variance_x_m2, true, true);
    return drift_m;
  }
  /// Flies down a corridor in which the variance grows to that given, with references and key scans on the way.
  double corridor(double from_m2, double to_m2) {
    double drift_m = 0.0;
    for (int i = 1; i <= 10; ++i) {
      ++key_;
      drift_m = scan(from_m2 + i * (to_m2 - from_m2) / 10.0, true, false, true);
    }
    return drift_m;
  }

  DriftMonitor monitor_;
  double time_s_ = 0.0;
  int key_ = 0, known_key_ = -1;
  bool turns_ = false;
};

TEST_F(Drift, DoesNotGrowWhileEveryDirectionIsSeen) {
  EXPECT_DOUBLE_EQ(see(10, 0.01), 0.0);
  EXPECT_DOUBLE_EQ(see(10, 4.0), 0.0) << "the filter's own covariance grows with the path";
}

TEST_F(Drift, GrowsAlongTheUnseenDirectionOnly) {
  see(10, 0.01);
  EXPECT_NEAR(scan(1.01, true, false), 1.0, 1e-9);
}

/// In a round room the error of the position goes with the distance from its middle.
TEST_F(Drift, OfAHiddenTurnGoesOnTheWayBack) {
  see(10, 0.0);
  turns_ = true;
  for (int leg = 0; leg < 20; ++leg) {
    EXPECT_NEAR(corridor(0.0, 0.09), 0.3, 1e-9) << leg;
    EXPECT_NEAR(corridor(0.09, 0.01), 0.1, 1e-9) << leg;
  }
}

TEST_F(Drift, TheErrorOfACorridorRemainsBehindIt) {
  see(10, 0.01);
  EXPECT_NEAR(corridor(0.01, 4.01), 2.0, 1e-9);
  EXPECT_NEAR(scan(4.01, true, true), 2.0, 1e-9) << "one good scan";
  ++key_;
  EXPECT_NEAR(see(50, 4.01), 2.0, 1e-9) << "a room behind it that was never seen before";
  EXPECT_NEAR(corridor(4.01, 9.01), 3.0, 1e-9) << "the next corridor adds to it";
}

TEST_F(Drift, IsTakenBackWhereKnownStructureIsSeenAgain) {
  see(10, 0.01);
  corridor(0.01, 4.01);
  known_key_ = 3;  // Mapped when 0.3 of the growth had happened.
  EXPECT_NEAR(scan(4.01, true, true), 2.0, 1e-9) << "a single scan is not believed";
  EXPECT_NEAR(see(10, 4.01), std::sqrt(1.2), 1e-9);
  known_key_ = 0;
  EXPECT_NEAR(see(10, 4.01), 0.0, 1e-9) << "the room at the start";
}

TEST_F(Drift, ToBeNearAnEarlierKeyScanProvesNothing) {
  see(10, 0.01);
  corridor(0.01, 4.01);
  key_ = 0;
  EXPECT_NEAR(see(10, 4.01), 2.0, 1e-9);
}

TEST_F(Drift, AGapIsForgottenWhenTheScansMatchTheSameReferenceAgain) {
  see(10, 0.01);
  EXPECT_NEAR(scan(0.26, false, false), 0.5, 1e-9);
  EXPECT_NEAR(see(10, 0.01), 0.0, 1e-9);
}

TEST_F(Drift, AGapRemainsWhenTheOdometryStartsAnew) {
  see(10, 0.01);
  scan(0.26, false, false);
  scan(0.26, false, false, true);
  ++key_;
  EXPECT_NEAR(see(10, 0.01), 0.5, 1e-9);
}

}  // namespace
}  // namespace swiftlet::autonomy
