// A mission takes the place of another in flight: the vehicle stops first, and nothing else gets it meanwhile.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "autonomy/mission_desk.hpp"
#include "tests/support/layers.hpp"

namespace swiftlet::autonomy {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string missionOf(const std::string& leaves) {
  return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\"><Sequence><TakeOff/>" + leaves +
         "<Land/></Sequence></BehaviorTree></root>";
}

/// The autonomy around the desk: one tick of the behaviours after the other.
class MissionDeskStory : public ::testing::Test {
 protected:
  MissionDeskStory() {
    test::Layers layers;
    layers.vehicle.flight_state = common::FlightState::kFlying;
    context_.world = std::make_shared<const common::World>(layers.world());
  }
  /// "running 3 go to (1.00, 2.00)": state, id of the intent, phase.
  std::string tick() {
    context_.now += common::Duration::fromMilliseconds(50);
    const behaviors::TickResult result = desk_.tick(context_);
    const std::string id = context_.intent ? std::to_string(context_.intent->id) : "-";
    return std::string(toString(result.state)) + " " + id + " " + result.phase;
  }
  MissionDeskStory& intentIs(common::IntentState state, bool released) {
    context_.status = {context_.intent ? context_.intent->id : 0, state, "", released};
    return *this;
  }
  std::string give(decltype(common::OperatorCommand::kind) kind) {
    const auto result = desk_.take({7, std::move(kind)});
    if (!result) return "not for the desk";
    return (result->accepted ? "accepted" : "refused") + (result->reason.empty() ? "" : ": " + result->reason);
  }
  std::string start(const std::string& leaves) {
    return give(common::StartMissionCommand{"new.xml", missionOf(leaves)});
  }

  behaviors::Context context_;
  MissionDesk desk_{behaviors::Mission::fromText(missionOf("<MoveToGoal goal=\"1;2\"/>"), "m.xml"),
                    {.max_height_m = 2.0}};
};

TEST_F(MissionDeskStory, WaitsForTheOperator) {
  desk_.waitForStart();
  EXPECT_EQ(tick(), "ready - wait for a mission");
  EXPECT_TRUE(desk_.waits());
  EXPECT_EQ(give(common::StopMissionCommand{}), "refused: no mission is being flown");
  EXPECT_EQ(start(""), "accepted");
  EXPECT_EQ(tick(), "running 1 take off to 1.00 m");
  EXPECT_FALSE(desk_.waits());
}

TEST_F(MissionDeskStory, AnotherMissionFollowsWhenTheVehicleHasStopped) {
  EXPECT_EQ(tick(), "running 1 take off to 1.00 m");
  intentIs(common::IntentState::kSucceeded, true);
  EXPECT_EQ(tick(), "running 2 go to (1.00, 2.00)");
  EXPECT_EQ(start("<MoveToGoal goal=\"-1;0\"/>"), "accepted: when the vehicle has stopped");
  intentIs(common::IntentState::kRunning, false);
  EXPECT_EQ(tick(), "running 3 stop the mission") << "it holds";
  intentIs(common::IntentState::kRunning, false);
  EXPECT_EQ(tick(), "running 3 stop the mission");
  intentIs(common::IntentState::kRunning, true);
  EXPECT_EQ(tick(), "running 4 take off to 1.00 m") << "the ids rise on: the same id is the same intent";
  intentIs(common::IntentState::kSucceeded, true);
  EXPECT_EQ(tick(), "running 5 go to (-1.00, 0.00)");
}

TEST_F(MissionDeskStory, AfterAStopItWaits) {
  tick();
  EXPECT_EQ(give(common::StopMissionCommand{}), "accepted: the vehicle holds until a mission is started, or it lands");
  intentIs(common::IntentState::kRunning, true);
  context_.commands.push_back({3, common::HomeCommand{}});
  tick();
  intentIs(common::IntentState::kRunning, true);
  EXPECT_EQ(tick(), "ready - wait for a mission");
  ASSERT_EQ(context_.results.size(), 1U) << "each command is answered";
  EXPECT_FALSE(context_.results[0].accepted);
  EXPECT_TRUE(desk_.noneFollows());
  EXPECT_EQ(start("<GoHome/>"), "accepted");
  EXPECT_FALSE(desk_.noneFollows());
  EXPECT_THAT(tick(), HasSubstr("take off"));
}

TEST_F(MissionDeskStory, AMissionThatCannotBeFlownChangesNothing) {
  tick();
  EXPECT_EQ(start("<MoveToGaol goal=\"1;1\"/>"),
            "refused: new.xml:1:65: MoveToGaol: unknown node `MoveToGaol`, did you mean `MoveToGoal`? "
            "[M/Sequence/MoveToGaol]");
  EXPECT_THAT(start("<MoveToGoal goal=\"1;1;9\"/><MoveToGoal goal=\"1;1;8\"/>"),
              HasSubstr("9 m is above the greatest height, 2 m"));
  intentIs(common::IntentState::kSucceeded, true);
  EXPECT_EQ(tick(), "running 2 go to (1.00, 2.00)");
}

TEST_F(MissionDeskStory, OtherCommandsAreNotForIt) {
  EXPECT_EQ(give(common::LandCommand{}), "not for the desk");
  EXPECT_EQ(give(common::GoalCommand{{1.0, 1.0}}), "not for the desk");
}

}  // namespace
}  // namespace swiftlet::autonomy
