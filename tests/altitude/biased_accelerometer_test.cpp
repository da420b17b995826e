// An accelerometer whose bias jumps in flight. The ground stands still, so what changes below a vehicle that hovers, or
// bends the way of the height in time, is the accelerometer.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/altitude/staircase_world.hpp"

namespace swiftlet::perception {
namespace {

/// The worst error of the height in five flights with that bias from 1.4 m on, over furniture; at rest with no speed.
double worst_m(double bias_m_s2, double speed_m_s) {
  double worst_m = 0.0;
  for (int seed = 1; seed <= 5; ++seed) {
    Overflight flight;
    flight.random = common::RandomStream(static_cast<std::uint64_t>(seed), "bias");
    flight.boxes = {{2.0, 2.6, -1, 1, 0.45}, {3.4, 4.6, -1, 1, 0.75}, {5.5, 5.9, -1, 1, 0.9}};
    flight.start();
    flight.climbTo(1.4);
    flight.acceleration_bias_m_s2 = bias_m_s2;
    flight.worst_error_m = 0.0;
    if (speed_m_s > 0.0)
      flight.flyTo({8.0, 0.0}, speed_m_s);
    else
      for (int i = 0; i < 400; ++i) flight.scan(0.0);
    worst_m = std::max(worst_m, flight.worst_error_m);
  }
  return worst_m;
}

TEST(MultilevelFilter, AJumpOfTheAccelerometersBiasMovesNothing) {
  for (const double bias_m_s2 : {-1.0, -0.3, 0.15, 0.3, 1.0})
    for (const double speed_m_s : {0.0, 0.3, 0.7})
      EXPECT_LT(worst_m(bias_m_s2, speed_m_s), 0.15) << bias_m_s2 << " m/s^2 at " << speed_m_s << " m/s";
}

TEST(MultilevelFilter, ABiasFromBeforeTheTakeOffIsLearnedAtRest) {
  Overflight flight;
  flight.acceleration_bias_m_s2 = 0.3;
  flight.start();
  for (int i = 0; i < 80; ++i) flight.scan(0.0);
  EXPECT_NEAR(flight.filter.state().bias_m_s2, 0.3, 0.05);
  flight.climbTo(1.4);
  EXPECT_LT(flight.worst_error_m, 0.03);
}

}  // namespace
}  // namespace swiftlet::perception
