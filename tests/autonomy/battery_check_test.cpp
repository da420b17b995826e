// Which samples of the battery are used.
#include "autonomy/energy/battery_check.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

common::BatterySample sample(double remaining, double voltage_v = 11.1) {
  return common::BatterySample{{}, voltage_v, remaining};
}

TEST(BatteryCheck, ReportsInvalidValuesOnce) {
  common::EventLog log;
  BatteryCheck check(log);
  EXPECT_TRUE(check.accepts(sample(0.5)));
  EXPECT_FALSE(check.accepts(sample(std::nan(""))));
  EXPECT_FALSE(check.accepts(sample(std::nan(""))));
  EXPECT_TRUE(check.accepts(sample(0.45)));
  EXPECT_EQ(log.take().size(), 2u);
}

TEST(BatteryCheck, AChargeThatJumpsIsUsedOnceItIsConfirmed) {
  common::EventLog log;
  BatteryCheck check(log);
  EXPECT_TRUE(check.accepts(sample(0.6)));
  EXPECT_FALSE(check.accepts(sample(0.0)));
  EXPECT_EQ(log.take().back().reason, "its charge jumps from 60 to 0 %");
  EXPECT_TRUE(check.accepts(sample(0.6)));
  EXPECT_FALSE(check.accepts(sample(0.11)));
  EXPECT_TRUE(check.accepts(sample(0.1)));
  EXPECT_FALSE(check.accepts(sample(-0.2)));
  EXPECT_FALSE(check.accepts(sample(0.1, 0.0)));
}

}  // namespace
}  // namespace swiftlet::autonomy
