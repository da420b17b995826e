// Flights with a given map: one localizes in a map made by another vehicle at another height, and a file that is not a
// map is refused before anything moves.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::readText;
using test_support::runSwiftlet;
using testing::HasSubstr;

class FlyWithMap : public test_support::Scratch {};

TEST_F(FlyWithMap, FindsItsPoseWithinFiveMetresInAMapFromAnotherHeight) {
  const ProgramEnd end = runSwiftlet({"trial", "trials/papers/freiburg_localize.yaml", "--repeat", "1", "--seed",
                                      "8101", "--json", "--out", path("out")});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const auto trial = nlohmann::json::parse(end.out)["trials"][0];
  const auto localization = trial["flights"][0]["localization"];
  EXPECT_EQ(localization["in_time"], true);
  EXPECT_LT(localization["error_m"], 0.15);
  EXPECT_EQ(localization["wrong_share"], 0.0);
  EXPECT_EQ(trial["localized_flights"], 1.0);
  const std::string run = "out/freiburg_localize-8101/";
  EXPECT_THAT(readText(path(run + "events.jsonl")), HasSubstr("localized at ("));
  const auto mission = nlohmann::json::parse(readText(path(run + "mission.json")));
  EXPECT_EQ(mission["localization"]["state"], "localized");
  EXPECT_FALSE(readText(path(run + "trajectory_given.tum")).empty());
}

TEST_F(FlyWithMap, AMissionThatNeedsAMapIsRefusedWithoutOne) {
  const ProgramEnd end = runSwiftlet({"fly", "missions/find_yourself.xml", "--headless", "--out", path("run")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_NE(end.err.find("find_yourself.xml:10"), std::string::npos) << end.err;
  EXPECT_NE(end.err.find("needs a map of the place"), std::string::npos) << end.err;
  EXPECT_FALSE(std::filesystem::exists(path("run")));
}

TEST_F(FlyWithMap, AnInvalidMapIsRefusedBeforeAnythingMoves) {
  const std::string mission = "missions/find_yourself.xml";
  const ProgramEnd none = runSwiftlet({"fly", mission, "--headless", "--map", path("none.yaml"), "--out", path("run")});
  EXPECT_EQ(none.exit_code, 2) << describe(none);
  EXPECT_THAT(none.err, HasSubstr("none.yaml"));
  write("grey.pgm", std::string("P5\n4 4\n255\n") + std::string(16, '\xcd'));
  const std::string grey = write("grey.yaml",
                                 "image: grey.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
                                 "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const ProgramEnd end = runSwiftlet({"fly", mission, "--headless", "--map", grey, "--out", path("run")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("no free cells"));
  EXPECT_FALSE(std::filesystem::exists(path("run")));
}

}  // namespace
}  // namespace swiftlet::commands
