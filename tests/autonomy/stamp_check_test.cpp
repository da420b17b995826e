// A stamp of the future is refused, and silences no sensor.
#include "autonomy/arrivals/stamp_check.hpp"

#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

using common::Time;

common::BatterySample batteryAt(double measured_s, double arrived_s) {
  return {{Time::fromSeconds(measured_s), Time::fromSeconds(arrived_s)}, 11.1, 0.5};
}
common::PilotSample pilotAt(double measured_s, double arrived_s) {
  return {{Time::fromSeconds(measured_s), Time::fromSeconds(arrived_s)}};
}

TEST(StampCheck, RefusesAStampOfTheFutureAndSaysSoOnce) {
  common::EventLog log;
  StampCheck check(log);
  EXPECT_TRUE(check.accepts(batteryAt(1.0, 1.02)));
  EXPECT_FALSE(check.accepts(batteryAt(1001.0, 1.2)));
  EXPECT_FALSE(check.accepts(batteryAt(1001.2, 1.4)));
  EXPECT_TRUE(check.accepts(pilotAt(1.4, 1.4)));
  EXPECT_TRUE(check.accepts(batteryAt(1.6, 1.62)));
  const auto events = log.take();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "measurement rejected: battery");
  EXPECT_EQ(events[0].reason, "its stamp lies 1e+03 s in the future");
}

TEST(StampCheck, ClocksThatDifferALittleAreNoFault) {
  common::EventLog log;
  StampCheck check(log);
  EXPECT_TRUE(check.accepts(batteryAt(1.07, 1.0))) << "20 ppm for an hour";
  EXPECT_FALSE(check.accepts(batteryAt(1.3, 1.1)));
}

}  // namespace
}  // namespace swiftlet::autonomy
