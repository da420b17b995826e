// What a wrong horizon of the autopilot does to a flight.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/control/flight_story.hpp"

namespace swiftlet::control {
namespace {

TEST(Flight, HoversWithinFiveCentimetresOnAWanderingHorizon) {
  double worst_m = 0, worst_height_m = 0;
  for (int seed = 1; seed <= 5; ++seed) {
    Flight flight;
    flight.model.random = common::RandomStream(static_cast<std::uint64_t>(seed), "hover");
    flight.hover();
    flight.run(3.0);
    const Rms rms = hoverFor(flight, 30.0, flight.controller.follower().reference().position_odom_m);
    worst_m = std::max(worst_m, rms.horizontal_m);
    worst_height_m = std::max(worst_height_m, rms.worst_vertical_m);
  }
  RecordProperty("hover_rms_m", std::to_string(worst_m));
  std::printf("hover: worst of 5 seeds %.3f m RMS horizontally, %.3f m worst vertically\n", worst_m, worst_height_m);
  EXPECT_LT(worst_m, 0.05);
  EXPECT_LT(worst_height_m, 0.05);
}

/// Setpoints are given in the autopilot's horizon. What is known of its error pushes nothing.
TEST(Flight, AKnownErrorOfTheHorizonDoesNotMoveIt) {
  const auto hoveredBy = [](bool knows_horizon) {
    double sum_m = 0.0;
    for (int seed = 1; seed <= 5; ++seed) {
      Flight flight;
      flight.model.random = common::RandomStream(static_cast<std::uint64_t>(seed), "hover");
      flight.knows_horizon = knows_horizon;
      flight.hover();
      flight.run(3.0);
      sum_m += hoverFor(flight, 20.0, flight.controller.follower().reference().position_odom_m).horizontal_m;
    }
    return sum_m / 5.0;
  };
  const double known_m = hoveredBy(true), unknown_m = hoveredBy(false);
  std::printf("hover: %.3f m RMS with a known horizon, %.3f m without\n", known_m, unknown_m);
  EXPECT_LT(known_m, 0.7 * unknown_m);
}

/// A horizon that leans with the vehicle, and drag: what makes up for them turns with it.
TEST(Flight, TheTrimTurnsWithTheVehicle) {
  Flight flight;
  flight.model.attitude_sigma_deg = 0.0;
  flight.model.horizon_pitch_rad = flight.model.horizon_roll_rad = 0.03;
  flight.model.attitude_correlation_s = 1e9;
  flight.hover();
  flight.run(8.0);
  const Eigen::Vector3d place = flight.controller.follower().reference().position_odom_m;
  ASSERT_TRUE(flight.controller.follow({{place}, FlightMode::kFast, 2.8}));
  const Rms rms = hoverFor(flight, 6.0, place);
  std::printf("turn by 160 deg: %.3f m RMS\n", rms.horizontal_m);
  EXPECT_NEAR(flight.model.yaw_rad, 2.8, 0.05);
  EXPECT_LT(rms.horizontal_m, 0.02);
}

}  // namespace
}  // namespace swiftlet::control
