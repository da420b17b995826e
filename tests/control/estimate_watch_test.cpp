// What follows when parts of the estimate are lost, and when.
#include "control/estimate_watch.hpp"

#include <string>

#include <gtest/gtest.h>

namespace swiftlet::control {
namespace {

using Change = EstimateWatch::Change;
using common::Time;

Time at(double seconds) { return Time::fromSeconds(seconds); }

/// What follows in flight, and why; empty if nothing does.
std::string followsAt(double seconds, const EstimateWatch& watch) {
  const Failsafe* row = watch.active(at(seconds), FlightPhase::kFlying, false);
  return row == nullptr ? "" : std::string(toString(row->response)) + ": " + watch.reason(row->finding);
}

TEST(EstimateWatch, ALostHeightBeginsTheEmergencyDescentAfterThreeTenths) {
  EstimateWatch watch;
  EXPECT_EQ(watch.observe(at(1.0), true, ""), Change::kNone);
  EXPECT_EQ(watch.observe(at(1.1), false, ""), Change::kNone) << "the change is that of the inertial samples";
  EXPECT_EQ(followsAt(1.39, watch), "");
  EXPECT_EQ(followsAt(1.4, watch), "descend: no valid height for 0.3 s");
  watch.observe(at(1.41), true, "");
  EXPECT_EQ(followsAt(9.0, watch), "");
}

TEST(EstimateWatch, InertialSamplesThatCannotBeUsedAreNamed) {
  EstimateWatch watch;
  EXPECT_EQ(watch.observe(at(1.0), true, "the samples repeat"), Change::kLost);
  EXPECT_EQ(watch.observe(at(1.1), true, "no samples"), Change::kNone);
  EXPECT_EQ(watch.inertialFault(), "no samples");
  EXPECT_EQ(followsAt(1.19, watch), "");
  EXPECT_EQ(followsAt(1.2, watch), "descend: no samples for 0.2 s");
  EXPECT_EQ(watch.observe(at(1.3), true, ""), Change::kBack);
  EXPECT_EQ(followsAt(9.0, watch), "");
  EXPECT_EQ(watch.inertialFault(), "");
}

TEST(EstimateWatch, ALostPositionLandsAfterASecond) {
  EstimateWatch watch;
  EXPECT_EQ(watch.observeHorizontal(at(1.0), true), Change::kNone);
  EXPECT_EQ(watch.observeHorizontal(at(2.0), false), Change::kLost);
  EXPECT_EQ(watch.observeHorizontal(at(2.9), false), Change::kNone);
  EXPECT_EQ(followsAt(2.9, watch), "");
  EXPECT_EQ(followsAt(3.0, watch), "land: no horizontal estimate for 1.0 s");
  EXPECT_EQ(watch.observeHorizontal(at(3.1), true), Change::kBack);
  EXPECT_EQ(followsAt(9.0, watch), "");
}

}  // namespace
}  // namespace swiftlet::control
