// A pilot steers at a wall with assistance, and touches nothing; without any share of the program, the same sticks
// crash.
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

class Assist : public test_support::Scratch {};

TEST_F(Assist, APilotWhoSteersAtAWallTouchesNothing) {
  const ProgramEnd end =
      runSwiftlet({"trial", "trials/assist.yaml", "--repeat", "1", "--seed", "9202", "--json", "--out", path("out")});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  const auto flight = nlohmann::json::parse(end.out)["trials"][0]["flights"][0];
  EXPECT_EQ(flight["collisions"], 0);
  EXPECT_GT(flight["distance_m"], 2.0) << "the sticks are obeyed";
}

TEST_F(Assist, TheSameSticksEndInACrashWhereTheProgramHasNoShare) {
  std::string alone = readText(SWIFTLET_SOURCE_DIR "/trials/assist.yaml");
  const std::string mixing = "program_share: 0.2";
  alone.replace(alone.find(mixing), mixing.size(), "program_share: 0.0");
  const ProgramEnd end = runSwiftlet(
      {"trial", write("alone.yaml", alone), "--repeat", "1", "--seed", "9202", "--json", "--out", path("out")});
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  EXPECT_GT(nlohmann::json::parse(end.out)["trials"][0]["flights"][0]["collisions"], 0);
}

}  // namespace
}  // namespace swiftlet::commands
