// A tick in flight allocates nothing: neither the controllers nor the state machine and the path around them.
#include <memory>

#include <gtest/gtest.h>

#include "tests/control/controller_fixtures.hpp"
#include "tests/control/flight_story.hpp"
#include "tests/support/allocations/counted_allocations.hpp"

namespace swiftlet::control {
namespace {

using test_support::allocations;

TEST(Allocation, IsCounted) {
  const long before = allocations;
  const auto planted = std::make_unique<int>(1);
  EXPECT_GT(allocations, before);
}

TEST(Allocation, ATickInFlightMakesNone) {
  const VehicleModel model = sheetModel();
  for (int kind = 0; kind < kControllerKinds; ++kind) {
    Flight flight(flightConfig(static_cast<ControllerKind>(kind)), &model);
    flight.hover();
    ASSERT_TRUE(flight.controller.follow({{{0, 0, 1}, {2, 0, 1}, {2, 2, 1}}, FlightMode::kFast, {}}));
    (void)flight.log.take();
    long made = 0;
    for (int i = 0; i < 600; ++i) {
      FlightTick tick;
      tick.now = flight.model.now;
      tick.state = flight.model.estimate();
      tick.raw_height = RawHeight{flight.model.now, flight.model.position_m.z()};
      tick.battery_v = flight.model.voltage_v;
      tick.acceleration_odom_m_s2 = flight.model.acceleration_m_s2;
      const long before = allocations;
      const common::Setpoint setpoint = flight.controller.tick(tick);
      made += allocations - before;
      flight.model.apply(setpoint);
      flight.model.advance(0.01);
    }
    EXPECT_EQ(made, 0) << toString(static_cast<ControllerKind>(kind));
    EXPECT_TRUE(flight.controller.state() == FlightState::kFlying);
  }
}

}  // namespace
}  // namespace swiftlet::control
