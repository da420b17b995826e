// The charge by the fuel gauge, and by the current where the gauge does not move.
#include "autonomy/energy/charge_counter.hpp"

#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

constexpr double kSheet_as = 18'000.0;

TEST(ChargeCounterTest, TheCapacityIsThatOfTheSheetUntilTheGaugeHasFallenFar) {
  ChargeCounter charge(kSheet_as);
  EXPECT_EQ(charge.capacity_as(), kSheet_as);
  charge.read(0.9);
  charge.takeOff(0.9);
  charge.draw(20.0, 36.0, true);
  charge.read(0.86);
  EXPECT_EQ(charge.capacity_as(), kSheet_as) << "4 % are too few";
  charge.draw(20.0, 36.0, true);
  charge.read(0.8);
  EXPECT_NEAR(charge.capacity_as(), 1440.0 / 0.1, 1e-9) << "a worn battery";
}

TEST(ChargeCounterTest, AGaugeThatStandsStillIsCountedOn) {
  ChargeCounter charge(kSheet_as);
  charge.read(0.9);
  charge.takeOff(0.9);
  charge.draw(20.0, 45.0, true);
  charge.read(0.9015);  // Noise is no move.
  EXPECT_FALSE(charge.standsStill()) << "exactly 5 %";
  charge.draw(20.0, 0.1, true);
  EXPECT_TRUE(charge.standsStill());
  EXPECT_NEAR(charge.counted(0.0), 0.9 - 902.0 / kSheet_as, 1e-12);
  EXPECT_NEAR(charge.counted(180.0), 0.89 - 902.0 / kSheet_as, 1e-12);
  EXPECT_EQ(charge.counted(2.0 * kSheet_as), 0.0);
  charge.read(0.85);
  EXPECT_FALSE(charge.standsStill());
}

TEST(ChargeCounterTest, ATakeOffForgetsWhatWasDrawnBefore) {
  ChargeCounter charge(kSheet_as);
  charge.read(0.3);
  charge.takeOff(0.3);
  charge.draw(20.0, 100.0, true);
  charge.read(1.0);
  charge.takeOff(1.0);
  EXPECT_FALSE(charge.standsStill());
  EXPECT_EQ(charge.capacity_as(), kSheet_as);
  EXPECT_EQ(charge.counted(0.0), 1.0);
}

TEST(ChargeCounterTest, TheGaugeTellsTheMeanCurrentWithoutAnAmmeter) {
  ChargeCounter charge(kSheet_as);
  charge.read(0.9);
  charge.takeOff(0.9);
  EXPECT_FALSE(charge.meanCurrent_a(0.86, 40.0));
  EXPECT_NEAR(charge.meanCurrent_a(0.8, 90.0).value(), 20.0, 1e-9);
}

}  // namespace
}  // namespace swiftlet::autonomy
