// The scripted operator, told step by step.
#include "evaluation/operator_script.hpp"

#include <gmock/gmock.h>

#include "tests/support/layers.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Time;
using testing::ElementsAre;
using testing::IsEmpty;

Time at(double seconds) { return Time::fromSeconds(seconds); }

OperatorStep step(OperatorAction command) {
  OperatorStep made;
  made.command = command;
  if (command == OperatorAction::kGoal) made.goal_map_m = {3.0, -1.5};
  return made;
}

std::vector<std::string> given(OperatorScript& script, double time_s) {
  std::vector<std::string> commands;
  for (const common::OperatorCommand& command : script.due(at(time_s))) {
    commands.push_back(toString(command));
    script.result({command.id, true, ""});
  }
  return commands;
}

void see(OperatorScript& script, const std::string& phase) {
  test::Layers layers;
  layers.mission.status.phase = phase;
  script.world(layers.world());
}

TEST(OperatorScript, GivesCommandsAtTheirTimeInTheirOrder) {
  std::vector<OperatorStep> steps = {step(OperatorAction::kGoal), step(OperatorAction::kHold)};
  steps[0].at_s = 10.0;
  steps[1].at_s = 5.0;
  OperatorScript script(steps, "");
  EXPECT_THAT(given(script, 9.99), IsEmpty());
  EXPECT_THAT(given(script, 10.0), ElementsAre("goal (3.00, -1.50)", "hold"));
  EXPECT_THAT(given(script, 20.0), IsEmpty());
  for (const OperatorAnswer& answer : script.answers()) EXPECT_EQ(answer.failure(), "");
}

TEST(OperatorScript, WaitsForAPhaseThatBeginsAfterTheStepBefore) {
  std::vector<OperatorStep> steps = {step(OperatorAction::kHold), step(OperatorAction::kResume)};
  steps[0].after_phase = "go to";
  steps[0].delay_s = 2.0;
  steps[1].after_phase = "go to";
  OperatorScript script(steps, "");
  see(script, "explore");
  EXPECT_THAT(given(script, 1.0), IsEmpty());
  see(script, "go to (1.00, 2.00)");
  EXPECT_THAT(given(script, 2.0), IsEmpty());
  see(script, "hold");
  EXPECT_THAT(given(script, 3.9), IsEmpty());
  EXPECT_THAT(given(script, 4.0), ElementsAre("hold")) << "the phase has come, even if it is over";
  EXPECT_THAT(given(script, 5.0), IsEmpty()) << "what came before the hold does not count for the resume";
  see(script, "go to (1.00, 2.00)");
  EXPECT_THAT(given(script, 5.1), ElementsAre("resume"));
}

TEST(OperatorScript, WaitsForAnEventAndForReachedGoals) {
  std::vector<OperatorStep> steps = {step(OperatorAction::kHome), step(OperatorAction::kLand)};
  steps[0].after_event = "no scan for";
  steps[1].after_goals = 1;
  OperatorScript script(steps, "");
  EXPECT_THAT(given(script, 1.0), IsEmpty());
  script.event({at(1.5), common::Severity::kWarning, "supervisor", "hold", "no scan for 0.31 s"});
  EXPECT_THAT(given(script, 2.0), ElementsAre("home"));
  script.intent({4, common::GoToIntent{}}, {4, common::IntentState::kRunning, "", true});
  EXPECT_THAT(given(script, 3.0), IsEmpty());
  script.intent({4, common::GoToIntent{}}, {4, common::IntentState::kSucceeded, "", true});
  EXPECT_THAT(given(script, 4.0), ElementsAre("land"));
}

TEST(OperatorScript, AnAnswerThatIsNotExpectedFails) {
  std::vector<OperatorStep> steps = {step(OperatorAction::kGoal), step(OperatorAction::kHold),
                                     step(OperatorAction::kLand)};
  steps[1].expect = ExpectedAnswer::kRefused;
  steps[2].at_s = 100.0;
  OperatorScript script(steps, "");
  const auto commands = script.due(at(1.0));
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_EQ(script.answers()[0].failure(), "operator: goal (3.00, -1.50) at 1.0 s: no answer");
  script.result({commands[0].id, false, "the vehicle is landing"});
  script.result({commands[1].id, false, "nothing to hold"});
  script.result({7, true, ""});  // Of a page.
  EXPECT_EQ(script.answers()[0].failure(), "operator: goal (3.00, -1.50) at 1.0 s: refused, the vehicle is landing");
  EXPECT_EQ(script.answers()[1].failure(), "");
  EXPECT_EQ(script.answers()[2].failure(), "operator: land: what it waits for never came");
}

TEST(OperatorScript, AddressesOneVehicleOrAll) {
  std::vector<OperatorStep> steps = {step(OperatorAction::kHold), step(OperatorAction::kLand)};
  steps[0].vehicle = "beta";
  OperatorScript alpha(steps, "alpha"), beta(steps, "beta");
  EXPECT_THAT(given(alpha, 1.0), ElementsAre("land"));
  EXPECT_THAT(given(beta, 1.0), ElementsAre("hold", "land"));
}

}  // namespace
}  // namespace swiftlet::evaluation
