// The events of a mission: which behaviour has the vehicle and why, and why it failed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::ElementsAre;

TEST(Narrator, ReportsWhichBehaviourControlsTheVehicleAndWhy) {
  Flight flight("<Priority><AvoidObstacle/><Hold/><Sequence><TakeOff/><Explore/><Land/></Sequence></Priority>");
  flight.tick();
  EXPECT_THAT(flight.events(),
              ElementsAre("TakeOff takes control (nothing above it asks for the vehicle)", "TakeOff starts"));
  flight.succeeds().tick();
  flight.events();
  flight.retreats(true, "a person 0.6 m ahead closing").runs().tick();
  EXPECT_THAT(flight.events(), ElementsAre("Explore yields to AvoidObstacle (a person 0.6 m ahead closing)",
                                           "AvoidObstacle takes over from Explore (a person 0.6 m ahead closing)"));
}

TEST(Narrator, NamesTheBehaviourBelowANode) {
  Flight flight("<Priority><Fallback><Hold/></Fallback><Sequence><TakeOff/><Explore/></Sequence></Priority>");
  flight.tick();
  flight.succeeds().tick();
  flight.events();
  flight.runs().holds(true, "the operator holds").tick();
  EXPECT_THAT(flight.events(), ElementsAre("Explore yields to Hold (the operator holds)"));
}

TEST(Narrator, NamesTheCausesOfAFailureInOrder) {
  Flight flight("<Fallback><Sequence><TakeOff/><Explore/></Sequence><Sequence><GoHome/><Land/></Sequence></Fallback>");
  flight.tick();
  flight.succeeds().tick();
  flight.fails("the vehicle is shut in").tick();
  EXPECT_EQ(flight.fails("goal (0.00, 0.00) is unreachable").tick(), "FAILED");
  EXPECT_EQ(flight.last.reason,
            "Explore: the vehicle is shut in [M/Fallback/Sequence[1]/Explore], and then GoHome: goal (0.00, 0.00) is "
            "unreachable [M/Fallback/Sequence[2]/GoHome]");
}

TEST(Narrator, LeavesOutFailuresThatAFallbackHandled) {
  Flight flight("<Sequence><Fallback><Explore/><TakeOff/></Fallback><Land/></Sequence>");
  flight.tick();
  flight.fails("cannot explore while powered off").tick();
  flight.succeeds().tick();
  EXPECT_EQ(flight.fails("the motors are off").tick(), "FAILED");
  EXPECT_EQ(flight.last.reason, "Land: the motors are off [M/Sequence/Land]");
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
