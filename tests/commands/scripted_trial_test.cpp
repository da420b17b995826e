// The shipped trials with a scripted operator and with phases, flown on one seed.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::runSwiftlet;

nlohmann::json flownTrial(const std::string& file, const std::string& out) {
  const ProgramEnd end =
      runSwiftlet({"trial", file, "--system", "swiftlet", "--repeat", "1", "--seed", "41", "--json", "--out", out});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  return nlohmann::json::parse(end.out).at("trials").at(0).at("flights").at(0);
}

class ScriptedTrial : public test_support::Scratch {};

TEST_F(ScriptedTrial, TheOperatorsCommandsAreGivenInOrderAndAnswered) {
  const auto flight = flownTrial("trials/operator_goals.yaml", path("run"));
  EXPECT_EQ(flight.at("verdict"), "home") << flight.at("verdict_reason");
  const auto& answers = flight.at("operator");
  ASSERT_EQ(answers.size(), 7u);
  double last_s = 0.0;
  for (const auto& answer : answers) {
    EXPECT_GE(answer.at("time_s").get<double>(), last_s) << answer;
    last_s = answer.at("time_s");
  }
  EXPECT_EQ(answers.at(1).at("command"), "hold");
  EXPECT_EQ(answers.at(1).at("accepted"), true);
  EXPECT_EQ(answers.at(6).at("accepted"), false) << "during the landing";
}

TEST_F(ScriptedTrial, AHoverHasTheFiguresOfItsPhase) {
  const auto flight = flownTrial("trials/papers/mit_hover.yaml", path("run"));
  const auto& hover = flight.at("phases").at("hover");
  EXPECT_GT(hover.at("time_s").get<double>(), 50.0);
  EXPECT_LT(hover.at("position_rms_m").get<double>(), 0.06);
  EXPECT_EQ(flight.at("verdict_reason"), "the operator's order: land");
}

TEST_F(ScriptedTrial, FlyTakesItsSystemAndChargeUnlessTheOptionsSayOtherwise) {
  const std::string trial = write("t.yaml",
                                  "mission: missions/explore_and_return.xml\nsystems: [swiftlet_urg, swiftlet]\n"
                                  "batteries: [0.5, 1.0]\nscenario: {world: worlds/unb_case1.sdf}\n");
  const auto flown = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {
        "fly",      "missions/explore_and_return.xml", "--headless", "--scenario", trial, "--time-limit", "1", "--out",
        path("run")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramEnd end = runSwiftlet(arguments);
    EXPECT_NE(end.exit_code, 2) << describe(end);
    return nlohmann::json::parse(test_support::readText(path("run/mission.json")));
  };
  const auto own = flown({});
  EXPECT_EQ(own.at("system"), "swiftlet_urg");
  EXPECT_NEAR(own.at("battery_remaining").get<double>(), 0.5, 0.05);
  const auto other = flown({"--system", "swiftlet", "--battery", "0.8"});
  EXPECT_EQ(other.at("system"), "swiftlet");
  EXPECT_NEAR(other.at("battery_remaining").get<double>(), 0.8, 0.05);
}

}  // namespace
}  // namespace swiftlet::commands
