// What the beams down tell of the vertical speed while the vehicle hovers: a height that drifts, edges, slopes, noise.
#include "perception/altitude/height_drift.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace swiftlet::perception {
namespace {

/// A vehicle whose estimate says that it hovers at 1 m, scanned at 40 Hz.
class Hovering : public testing::Test {
 protected:
  void scan(double below_m, double x_m = 0.0, double height_m = 1.0) {
    now_ += common::Duration::fromMilliseconds(25);
    const double noise_m = random_.gaussian(0.008);
    if (const auto rate = drift_.add(now_, {x_m, 0.0}, below_m + noise_m, height_m)) {
      ++said_;
      rate_m_s_ = rate->speed_m_s;
    }
  }

  HeightDrift drift_;
  common::Time now_;
  common::RandomStream random_{1, "beams"};
  int said_ = 0;
  double rate_m_s_ = 0.0;
};

TEST_F(Hovering, NoiseAndWanderingAreNoDrift) {
  for (int i = 0; i < 4000; ++i) scan(1.0 + 0.02 * std::sin(0.05 * i));
  EXPECT_EQ(said_, 0);
}

TEST_F(Hovering, AClimbThatTheEstimateDoesNotHaveIsSaidBeforeItIsHigh) {
  double climbed_m = 0.0, speed_m_s = 0.0;
  while (said_ == 0 && climbed_m < 1.0) {
    speed_m_s += 0.5 * 0.025;
    climbed_m += speed_m_s * 0.025;
    scan(1.0 + climbed_m);
  }
  EXPECT_LT(climbed_m, 0.15);
  EXPECT_NEAR(rate_m_s_, speed_m_s, 0.2);
  EXPECT_GT(rate_m_s_, 0.0);
}

TEST_F(Hovering, AClimbThatTheEstimateHasIsNone) {
  for (int i = 0; i < 200; ++i) scan(1.0 + 0.02 * i, 0.0, 1.0 + 0.02 * i);
  EXPECT_EQ(said_, 0);
}

TEST_F(Hovering, EdgesBelowAreNoDrift) {
  for (int i = 0; i < 400; ++i) scan(i / 30 % 2 == 0 ? 1.0 : 0.6);
  EXPECT_EQ(said_, 0);
}

TEST_F(Hovering, GroundThatSlopesAlongThePathIsNoDrift) {
  for (int i = 0; i < 400; ++i) scan(1.0 + 0.4 * 0.7 * 0.025 * i, 0.7 * 0.025 * i);
  EXPECT_EQ(said_, 0);
}

TEST_F(Hovering, WhatIsNoNumberIsLeftOut) {
  for (int i = 0; i < 100; ++i) scan(std::numeric_limits<double>::quiet_NaN());
  for (int i = 0; i < 100; ++i) scan(std::numeric_limits<double>::infinity());
  EXPECT_EQ(said_, 0);
}

}  // namespace
}  // namespace swiftlet::perception
