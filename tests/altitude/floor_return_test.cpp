// The vehicle finds the floor again after a ramp that nothing told it of.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/altitude/staircase_world.hpp"

namespace swiftlet::perception {
namespace {

/// Slowly up a gentle ramp of 0.16 m, which the beams down cannot tell from a floor below a vehicle that sinks, off its
/// upper edge, and back around it over the floor from which the flight began.
Overflight overARamp(int seed) {
  Overflight flight;
  flight.random = common::RandomStream(static_cast<std::uint64_t>(seed), "floor");
  flight.boxes = {{3.0, 6.0, -0.6, 0.6, 0.0, 0.16}};
  flight.start();
  flight.climbTo(1.2);
  flight.flyTo({8.0, 0.0}, 0.35);
  flight.flyTo({8.0, 1.5}, 0.7);
  flight.flyTo({2.9, 1.5}, 0.7);
  flight.flyTo({2.9, 0.05}, 0.7);
  return flight;
}

TEST(FloorReturn, TheHeightIsRightOverTheFloorThatWasSeenBefore) {
  for (int seed = 1; seed <= 8; ++seed) {
    Overflight flight = overARamp(seed);
    flight.flyTo({0.0, 0.05}, 0.7);
    EXPECT_NEAR(flight.filter.state().height_m, flight.z_m, 0.08) << "seed " << seed;
    EXPECT_EQ(flight.filter.levels().levels.front().height_m, 0.0);
  }
}

TEST(FloorReturn, ATableThatWasMovedIntoTheWayIsNoFloor) {
  Overflight flight;
  flight.start();
  flight.climbTo(1.5);
  flight.flyTo({6.0, 0.0}, 0.7);
  flight.boxes = {{2.0, 3.8, -0.5, 0.5, 0.75}};
  flight.flyTo({0.0, 0.0}, 0.7);
  EXPECT_FALSE(flight.regained_m);
  EXPECT_NEAR(flight.filter.state().height_m, flight.z_m, 0.05);
}

}  // namespace
}  // namespace swiftlet::perception
