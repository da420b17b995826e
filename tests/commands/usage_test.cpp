// What each command says of itself, and that what it prints can be used.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::runSwiftlet;
using testing::HasSubstr;

class Help : public testing::TestWithParam<std::string> {};

TEST_P(Help, SaysWhatItDoesWithAnExample) {
  const ProgramEnd end = runSwiftlet({GetParam(), "--help"});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("Example: swiftlet " + GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Commands, Help,
                         testing::Values("fly", "check", "trial", "config", "doctor", "version", "optimize", "map",
                                         "localize", "evaluate"),
                         [](const auto& command) { return command.param; });

TEST(Usage, HelpOfAllNamesEachCommand) {
  const ProgramEnd end = runSwiftlet({"--help"});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  for (const std::string command :
       {"fly", "check", "trial", "config", "doctor", "version", "optimize", "map", "localize", "evaluate"})
    EXPECT_THAT(end.out, HasSubstr("\n  " + command));
}

TEST(Usage, VersionAndDoctorAreJsonWhenAsked) {
  EXPECT_EQ(runSwiftlet({"version"}).exit_code, 0);
  EXPECT_TRUE(nlohmann::json::accept(runSwiftlet({"version", "--json"}).out));
  EXPECT_TRUE(nlohmann::json::accept(runSwiftlet({"doctor", "--json"}).out));
}

}  // namespace
}  // namespace swiftlet::commands
