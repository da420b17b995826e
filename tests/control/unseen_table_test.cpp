// Landings on what the beams down do not see: a table of glass, or the edges of a gap.
#include "tests/control/flight_story.hpp"

namespace swiftlet::control {
namespace {

Flight aboveGlass() {
  Flight flight;
  flight.hover(1.5);
  flight.model.floor_m = flight.unseen_table_m = 0.45;
  return flight;
}

TEST(UnseenTable, ALandingEndsOnIt) {
  Flight flight = aboveGlass();
  ASSERT_TRUE(flight.controller.command(Land{}));
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kLanded; }, 15.0));
  EXPECT_NEAR(flight.model.position_m.z(), 0.45 + QuadrotorModel::kStanding_m, 1e-6);
}

TEST(UnseenTable, AnEmergencyLandingEndsOnIt) {
  Flight flight = aboveGlass();
  flight.diverged = true;
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kPoweredOff; }, 20.0));
  EXPECT_NEAR(flight.model.position_m.z(), 0.45 + QuadrotorModel::kStanding_m, 1e-6);
  EXPECT_LT(flight.model.hardest_touch_m_s, 0.7) << "at the speed of the descent, as it comes unseen";
}

}  // namespace
}  // namespace swiftlet::control
