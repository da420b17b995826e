// The filter allocates nothing in flight: neither its steps, nor late measurements and the replay that they cause, nor
// clones that take the place of others, nor the queries of the 100 Hz tick.
#include <gtest/gtest.h>

#include "tests/fusion/synthetic_flight.hpp"
#include "tests/support/allocations/counted_allocations.hpp"

namespace swiftlet::perception {
namespace {

TEST(Allocation, TheFilterMakesNoneInFlight) {
  SyntheticFlight flight(1, 8.0);
  flight.delay_s = 0.173;
  flight.camera_hz = 15.0;
  const auto samples = flight.imuSamples();
  const auto deliveries = flight.deliveries();
  ErrorStateFilter filter({});
  long before = 0, after = 0;
  feed(filter, samples, deliveries, flight.restUntil(), [&](double t) {
    (void)filter.state();
    (void)filter.estimate();
    (void)filter.status();
    (void)filter.poseAt(filter.newest() - common::Duration::fromSeconds(0.1));
    (t < 1.0 ? before : after) = test_support::allocations;
  });
  EXPECT_GT(filter.counts().replays, 1000u) << "measurements came late";
  EXPECT_EQ(after - before, 0);
}

}  // namespace
}  // namespace swiftlet::perception
