// Gains are taken back where roll and pitch swing, and only there.
#include "control/oscillation_guard.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/geometry.hpp"

namespace swiftlet::control {
namespace {

class OscillationGuardStory : public testing::Test {
 protected:
  /// Ticks of 10 ms with this pitch, as a function of the time since the start.
  template <typename Pitch>
  void fly(double seconds, Pitch pitch_deg) {
    for (const double end_s = now_s_ + seconds; now_s_ < end_s - 1e-9;) {
      now_s_ += 0.01;
      guard_.observe(common::quaternionFrom({0.0, pitch_deg(now_s_) * common::kRadPerDeg, 1.0}), 0.01);
      least_ = std::min(least_, guard_.share());
    }
  }

  OscillationGuard guard_;
  double now_s_ = 0.0;
  double least_ = 1.0;
};

TEST_F(OscillationGuardStory, AManoeuvreIsNoOscillation) {
  fly(2.0, [](double) { return 1.0; });
  fly(6.0, [](double t_s) { return t_s < 3.0 ? 5.0 : t_s < 4.0 ? -5.0 : t_s < 6.0 ? 0.0 : 5.0; });
  EXPECT_EQ(least_, 1.0);
}

TEST_F(OscillationGuardStory, ALimitCycleTakesTheGainsBackAndTheyReturnSlowly) {
  fly(2.0, [](double t_s) { return 20.0 * std::sin(2.0 * M_PI * t_s / 0.6); });
  EXPECT_LT(guard_.share(), 0.5);
  EXPECT_GE(guard_.share(), OscillationGuard::kLeastShare);
  const double swinging = guard_.share();
  fly(1.0, [](double) { return 0.0; });
  EXPECT_LT(guard_.share(), 0.5 * (1.0 + swinging)) << "the swing has only just ended";
  fly(20.0, [](double) { return 0.0; });
  EXPECT_GT(guard_.share(), 0.95);
}

TEST_F(OscillationGuardStory, AConstantTiltIsNoSwing) {
  fly(5.0, [](double) { return 15.0; });
  EXPECT_NEAR(guard_.swing_rad(), 0.0, 1e-6);
  EXPECT_EQ(least_, 1.0);
}

}  // namespace
}  // namespace swiftlet::control
