// A surface that comes into sight while the vertical speed is wrong: is it a slope, or does the vehicle climb?
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "tests/altitude/staircase_world.hpp"

namespace swiftlet::perception {
namespace {

/// Over clutter without a level a vehicle climbs and does not know it. Where the floor comes into sight again, it seems
/// to sink, as a slope would; but it lies where the floor is expected, and is soon believed.
TEST(MultilevelFilter, BelievesTheFloorAgainThoughTheVehicleClimbsUnknowingly) {
  int unmeasured = 0, wrong = 0;
  constexpr int kFlights = 40;
  for (int seed = 1; seed <= kFlights; ++seed) {
    Overflight flight;
    flight.random = common::RandomStream(static_cast<std::uint64_t>(seed), "climb");
    const double end_m = flight.addClutter(1.0, 1.8, 0.2, 0.9);
    flight.start();
    flight.climbTo(1.4);
    flight.flyTo({1.0, 0.0}, 0.7);
    flight.acceleration_bias_m_s2 = -0.06;
    flight.flyTo({end_m + 0.5, 0.0}, 0.7);
    unmeasured += flight.last.vertical ? 0 : 1;
    wrong += std::abs(flight.filter.state().height_m - flight.z_m) < 0.06 ? 0 : 1;
  }
  std::printf("floor below a climb: %d unmeasured, %d wrong\n", unmeasured, wrong);
  EXPECT_LE(unmeasured, kFlights / 10);
  EXPECT_LE(wrong, kFlights / 10);
}

/// The back of a sofa falls by 20 deg below the vehicle for 1.2 s: that is a slope, and the vehicle does not sink.
TEST(MultilevelFilter, TheBackOfASofaIsNoLevelBelowAVehicleThatSinks) {
  int wrong = 0;
  constexpr int kFlights = 40;
  for (int seed = 1; seed <= kFlights; ++seed) {
    Overflight flight;
    flight.random = common::RandomStream(static_cast<std::uint64_t>(seed), "sofa");
    const double end_m = flight.addClutter(1.0, 2.0, 0.2, 0.7);
    flight.boxes.push_back({end_m, end_m + 0.85, -1.0, 1.0, 0.75, 0.44});
    flight.start();
    flight.climbTo(1.4);
    flight.flyTo({end_m + 0.8, 0.0}, 0.7);
    wrong += std::abs(flight.filter.state().height_m - flight.z_m) < 0.1 ? 0 : 1;
  }
  std::printf("back of a sofa: %d of %d heights err by more than 0.1 m\n", wrong, kFlights);
  EXPECT_LE(wrong, kFlights / 20);
}

}  // namespace
}  // namespace swiftlet::perception
