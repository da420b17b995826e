// The conditions: what they answer, and why not.
#include <gtest/gtest.h>

#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using test::Layers;

/// "" if the condition holds, else its reason.
std::string objectionOf(
    const std::string& condition, const std::function<void(Layers&)>& change = [](Layers&) {}) {
  Flight flight(condition);
  flight.change(change);
  return flight.tick() == "DONE" ? "" : flight.cause().substr(flight.cause().find(": ") + 2);
}

TEST(Conditions, IsBatteryLow) {
  const auto left = [](double share) { return [share](Layers& layers) { layers.energy.battery_remaining = share; }; };
  EXPECT_EQ(objectionOf("<IsBatteryLow share='0.4'/>", left(0.39)), "");
  EXPECT_EQ(objectionOf("<IsBatteryLow share='0.4'/>", left(0.62)), "62 % of the battery left");
}

TEST(Conditions, IsHomeReachable) {
  EXPECT_EQ(objectionOf("<IsHomeReachable/>"), "the consumption is not known yet");
  const auto with = [](double remaining) {
    return [remaining](Layers& layers) {
      layers.energy.battery_remaining = remaining;
      layers.energy.land_share = 0.12;
      layers.energy.home_share = 0.10;
    };
  };
  EXPECT_EQ(objectionOf("<IsHomeReachable/>", with(0.28)), "");
  EXPECT_EQ(objectionOf("<IsHomeReachable/>", with(0.25)), "home takes 10 % of the battery, 8 % are left for it");
  EXPECT_EQ(objectionOf("<IsHomeReachable reserve_share='0'/>", with(0.25)), "");
}

TEST(Conditions, IsLost) {
  const auto state = [](bool valid, double drift_m) {
    return [=](Layers& layers) {
      layers.vehicle.state.horizontal_valid = valid;
      layers.vehicle.drift_m = drift_m;
    };
  };
  EXPECT_EQ(objectionOf("<IsLost/>", state(true, 0.1)), "the position is known to 0.10 m");
  EXPECT_EQ(objectionOf("<IsLost/>", state(true, 0.6)), "");
  EXPECT_EQ(objectionOf("<IsLost/>", state(false, 0.0)), "");
  EXPECT_EQ(objectionOf("<IsLost/>",
                        [&](Layers& layers) {
                          state(true, 0.1)(layers);
                          layers.map.localization.emplace().state = common::LocalizationState::kLost;
                        }),
            "");
}

TEST(Conditions, IsOperatorHolding) {
  EXPECT_EQ(objectionOf("<IsOperatorHolding/>"), "nobody holds");
  Flight flight("<IsOperatorHolding/>");
  EXPECT_EQ(flight.holds(true).tick(), "DONE");
}

TEST(Conditions, IsPersonNear) {
  EXPECT_EQ(objectionOf("<IsPersonNear/>"), "nobody is seen");
  const auto person = [](double x_m) {
    return [x_m](Layers& layers) { layers.people.people.push_back({{x_m, 0.0}, 0.3}); };
  };
  EXPECT_EQ(objectionOf("<IsPersonNear distance_m='2'/>", person(2.2)), "");
  EXPECT_EQ(objectionOf("<IsPersonNear distance_m='2'/>", person(-2.4)), "the nearest person is 2.1 m away");
}

TEST(Conditions, IsExplored) {
  EXPECT_EQ(objectionOf("<IsExplored/>"), "nothing has been explored yet");
  const auto frontier = [](common::FrontierReason reason) {
    return [reason](Layers& layers) {
      layers.map.explored_area_m2 = 20.0;
      std::vector<common::Frontier> frontiers(1);
      frontiers.front().reason = reason;
      layers.map.frontiers = std::make_shared<const std::vector<common::Frontier>>(frontiers);
    };
  };
  EXPECT_EQ(objectionOf("<IsExplored/>", frontier(common::FrontierReason::kOpen)), "1 frontier is open");
  EXPECT_EQ(objectionOf("<IsExplored/>", frontier(common::FrontierReason::kBlocked)), "1 frontier is blocked");
  EXPECT_EQ(objectionOf("<IsExplored/>", frontier(common::FrontierReason::kUnreachable)), "");
}

TEST(Conditions, IsAt) {
  const auto at = [](double x_m, double z_m, bool valid = true) {
    return [=](Layers& layers) {
      layers.vehicle.state.T_odom_body.position_m = {x_m, 0.0, z_m};
      layers.vehicle.state.horizontal_valid = valid;
    };
  };
  EXPECT_EQ(objectionOf("<IsAt place='1;0'/>", at(1.2, 5.0)), "");
  EXPECT_EQ(objectionOf("<IsAt place='1;0'/>", at(1.5, 1.0)), "it is 0.50 m away");
  EXPECT_EQ(objectionOf("<IsAt place='1;0;1'/>", at(1.0, 1.4)), "it is 0.40 m higher or lower");
  EXPECT_EQ(objectionOf("<IsAt place='1;0'/>", at(1.0, 1.0, false)), "the position is not known");
}

TEST(Conditions, EndWhatTheyGuard) {
  Flight flight("<ReactiveFallback><IsBatteryLow share='0.3'/><Patrol points='1;0'/></ReactiveFallback>");
  EXPECT_EQ(flight.tick(), "RUNNING 1 go to (1.00, 0.00)");
  flight.runs().tick();
  flight.change([](Layers& layers) { layers.energy.battery_remaining = 0.2; });
  flight.tick();
  EXPECT_EQ(flight.stops().tick(), "DONE") << "once the vehicle has stopped";
  for (const std::string& event : flight.events())
    EXPECT_EQ(event.find("failed"), std::string::npos) << "an answer is not a failure: " << event;
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
