// The current of flying, measured in flight.
#include "autonomy/energy/current_model.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

/// Two minutes at 10 Hz, in legs of 5 s at `fast_m_s` and stops of 5 s.
CurrentModel flown(double hover_a, double per_speed_as_m, double fast_m_s) {
  CurrentModel model;
  for (int i = 0; i < 1200; ++i) {
    const double speed_m_s = (i / 50) % 2 == 0 ? 0.0 : fast_m_s;
    model.add(hover_a + per_speed_as_m * speed_m_s, speed_m_s, 0.1);
  }
  return model;
}

TEST(CurrentModelTest, NothingIsDrawnBeforeItWasMeasured) { EXPECT_EQ(CurrentModel{}.drawn_as(10.0, 5.0), 0.0); }

TEST(CurrentModelTest, HoveringAndMetresAreToldApart) {
  const CurrentModel model = flown(18.0, 2.0, 2.0);
  EXPECT_NEAR(model.drawn_as(10.0, 0.0), 180.0, 2.0) << "hovering";
  EXPECT_NEAR(model.drawn_as(10.0, 20.0), 220.0, 2.0) << "at 2 m/s";
}

TEST(CurrentModelTest, OneSpeedTellsNothingOfOthers) {
  CurrentModel model;
  for (int i = 0; i < 1200; ++i) model.add(18.0 + 0.5 * std::sin(i), 0.5 + 0.02 * std::sin(i), 0.1);
  EXPECT_NEAR(model.drawn_as(10.0, 0.0), 180.0, 3.0) << "the noise would make it far less";
}

TEST(CurrentModelTest, FollowsTheBattery) {
  CurrentModel model = flown(18.0, 0.0, 1.0);
  for (int i = 0; i < 3000; ++i) model.add(21.0, 0.0, 0.1);
  EXPECT_NEAR(model.drawn_as(1.0, 0.0), 21.0, 0.1);
}

TEST(CurrentModelTest, ValuesThatAreNoNumbersAreIgnored) {
  CurrentModel model = flown(18.0, 0.0, 1.0);
  model.add(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.1);
  model.add(18.0, std::numeric_limits<double>::infinity(), 0.1);
  EXPECT_NEAR(model.drawn_as(1.0, 0.0), 18.0, 0.1);
}

}  // namespace
}  // namespace swiftlet::autonomy
