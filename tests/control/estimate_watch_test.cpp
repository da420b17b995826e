// What follows when parts of the estimate are lost, and when.
#include "control/estimate_watch.hpp"

#include <string>

#include <gtest/gtest.h>

namespace swiftlet::control {
namespace {

using common::Edge;
using common::Time;

Time at(double seconds) { return Time::fromSeconds(seconds); }

/// What follows in flight, and why; empty if nothing does.
std::string followsAt(double seconds, const EstimateWatch& watch) {
  const Failsafe* row = watch.active(at(seconds), FlightPhase::kFlying, false);
  return row == nullptr ? "" : std::string(toString(row->response)) + ": " + watch.reason(row->finding);
}

TEST(EstimateWatch, ALostHeightBeginsTheEmergencyDescentAfterThreeTenths) {
  common::EventLog log;
  EstimateWatch watch(log);
  watch.observe(at(1.0), true, "");
  watch.observe(at(1.1), false, "");
  EXPECT_EQ(followsAt(1.39, watch), "");
  EXPECT_EQ(followsAt(1.4, watch), "descend: no valid height for 0.3 s");
  watch.observe(at(1.41), true, "");
  EXPECT_EQ(followsAt(9.0, watch), "");
}

TEST(EstimateWatch, InertialSamplesThatCannotBeUsedAreNamed) {
  common::EventLog log;
  EstimateWatch watch(log);
  watch.observe(at(1.0), true, "the samples repeat");
  watch.observe(at(1.1), true, "no samples");
  const auto events = log.take();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].reason, "the samples repeat");
  EXPECT_EQ(watch.inertialFault(), "no samples");
  EXPECT_EQ(followsAt(1.19, watch), "");
  EXPECT_EQ(followsAt(1.2, watch), "descend: no samples for 0.2 s");
  watch.observe(at(1.3), true, "");
  EXPECT_EQ(log.take().size(), 1U) << "they are good again";
  EXPECT_EQ(followsAt(9.0, watch), "");
  EXPECT_EQ(watch.inertialFault(), "");
}

TEST(EstimateWatch, ALostPositionLandsAfterASecond) {
  common::EventLog log;
  EstimateWatch watch(log);
  EXPECT_EQ(watch.observeHorizontal(at(1.0), true, false), Edge::kNone);
  EXPECT_EQ(watch.observeHorizontal(at(2.0), false, false), Edge::kEntered);
  EXPECT_EQ(watch.observeHorizontal(at(2.9), false, false), Edge::kNone);
  EXPECT_EQ(followsAt(2.9, watch), "");
  EXPECT_EQ(followsAt(3.0, watch), "land: no horizontal estimate for 1.0 s");
  EXPECT_EQ(watch.observeHorizontal(at(3.1), true, false), Edge::kLeft);
  EXPECT_EQ(followsAt(9.0, watch), "");
}

TEST(EstimateWatch, WhileTheVelocityIsKnownALostPositionLandsAfterThreeSeconds) {
  common::EventLog log;
  EstimateWatch watch(log);
  EXPECT_EQ(watch.observeHorizontal(at(2.0), false, true), Edge::kEntered);
  EXPECT_EQ(followsAt(4.9, watch), "");
  EXPECT_EQ(followsAt(5.0, watch), "land: no horizontal estimate for 3.0 s");
  EXPECT_EQ(watch.observeHorizontal(at(4.5), false, false), Edge::kNone);
  EXPECT_EQ(followsAt(4.5, watch), "land: no horizontal estimate for 1.0 s");
}

}  // namespace
}  // namespace swiftlet::control
