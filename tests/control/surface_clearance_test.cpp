// The vehicle keeps its distance to what it flies over.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "control/surface_clearance.hpp"

namespace swiftlet::control {
namespace {

using common::Time;

struct Clearance : testing::Test {
  /// Flies for that long over a surface at this height, on a path at `wanted_m`.
  void over(double surface_m, double seconds, double wanted_m = 1.0) {
    for (int i = 0; i < static_cast<int>(100.0 * seconds); ++i) {
      now = now + common::kControlPeriod;
      const double height_m = wanted_m + clearance.lift_m();
      if (i % 3 == 0) clearance.observe({now, height_m - surface_m}, height_m);
      fastest_m_s = std::max(fastest_m_s, std::abs(raised(wanted_m).velocity_odom_m_s.z()));
    }
  }

  Reference raised(double wanted_m, double max_height_m = 10.0) {
    Reference path;
    path.position_odom_m.z() = wanted_m;
    return clearance.raised(path, now, max_height_m, common::kControlPeriod.seconds());
  }

  Time now = Time::fromSeconds(5.0);
  SurfaceClearance clearance{{}};
  double fastest_m_s = 0.0;
};

TEST_F(Clearance, AFloorAndALowBoxLeaveThePathAsItIs) {
  over(0.0, 2.0);
  over(0.5, 2.0);
  EXPECT_EQ(clearance.lift_m(), 0.0);
}

TEST_F(Clearance, ATableLiftsThePathAndTheFloorBehindItLetsItDown) {
  over(0.75, 1.0);
  EXPECT_NEAR(clearance.lift_m(), 0.15, 1e-9);
  over(0.0, 0.5);
  EXPECT_NEAR(clearance.lift_m(), 0.15, 1e-9) << "the rear of the hull is still over it";
  over(0.0, 3.0);
  EXPECT_EQ(clearance.lift_m(), 0.0);
  EXPECT_LE(fastest_m_s, 0.4 + 1e-9);
}

TEST_F(Clearance, AFlightThatIsMeantToBeLowStaysLow) {
  over(0.0, 2.0, 0.3);
  EXPECT_EQ(clearance.lift_m(), 0.0);
  over(0.2, 2.0, 0.3);
  EXPECT_NEAR(clearance.lift_m(), 0.2, 1e-9);
}

/// The distance is what counts: an estimate that is wrong by a constant lifts as much.
TEST_F(Clearance, AWrongHeightLiftsAllTheSame) {
  for (int i = 0; i < 200; ++i) {
    now = now + common::kControlPeriod;
    clearance.observe({now, 0.25 + clearance.lift_m()}, 1.3 + clearance.lift_m());
    (void)raised(1.3);
  }
  EXPECT_NEAR(clearance.lift_m(), 0.15, 1e-9);
}

TEST_F(Clearance, TheGreatestHeightBoundsTheLiftAndLowersNoPath) {
  over(0.75, 1.0);
  EXPECT_EQ(raised(1.0, 1.05).position_odom_m.z(), 1.05);
  EXPECT_NEAR(clearance.lift_m(), 0.05, 1e-9);
  EXPECT_EQ(raised(1.0, 0.8).position_odom_m.z(), 1.0);
  EXPECT_EQ(clearance.lift_m(), 0.0);
  EXPECT_NEAR(raised(1.0).position_odom_m.z(), 1.15, 1e-9);
}

TEST_F(Clearance, WithoutMeasurementsNothingIsBelow) {
  over(0.75, 1.0);
  for (int i = 0; i < 500; ++i) {
    now = now + common::kControlPeriod;
    (void)raised(1.0);
  }
  EXPECT_EQ(clearance.lift_m(), 0.0);
}

}  // namespace
}  // namespace swiftlet::control
