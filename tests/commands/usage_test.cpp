// The help of each command, and that its examples work.
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

TEST_P(Help, DescribesTheCommandWithAnExample) {
  const ProgramEnd end = runSwiftlet({GetParam(), "--help"});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("Example: swiftlet " + GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Commands, Help,
                         testing::Values("fly", "check", "trial", "config", "doctor", "version", "optimize", "map",
                                         "map3d", "localize", "evaluate", "nodes", "migrate", "explore-bench"),
                         [](const auto& command) {
                           std::string name = command.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(Usage, GeneralHelpNamesEachCommand) {
  const ProgramEnd end = runSwiftlet({"--help"});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  for (const std::string command : {"fly", "check", "trial", "config", "doctor", "version", "optimize", "map", "map3d",
                                    "localize", "evaluate", "migrate"})
    EXPECT_THAT(end.out, HasSubstr("\n  " + command));
}

TEST(Usage, VersionAndDoctorAreJsonWhenAsked) {
  EXPECT_EQ(runSwiftlet({"version"}).exit_code, 0);
  const auto version = nlohmann::json::parse(runSwiftlet({"version", "--json"}).out);
  EXPECT_THAT(version["commit"].get<std::string>(), testing::MatchesRegex("unknown|[0-9a-f]+"));
  EXPECT_EQ(version["dirty"].is_null(), version["commit"] == "unknown");
  EXPECT_TRUE(nlohmann::json::accept(runSwiftlet({"doctor", "--json"}).out));
}

TEST(Usage, VersionIsAlsoAnOption) {
  const ProgramEnd option = runSwiftlet({"--version"});
  EXPECT_EQ(option.exit_code, 0) << describe(option);
  EXPECT_EQ(option.out, runSwiftlet({"version"}).out);
}

TEST(Usage, SuggestsTheClosestName) {
  const auto told = [](const std::vector<std::string>& arguments, const std::string& message) {
    const ProgramEnd end = runSwiftlet(arguments);
    EXPECT_EQ(end.exit_code, 2) << describe(end);
    EXPECT_THAT(end.err, HasSubstr(message));
    EXPECT_EQ(end.out, "");
  };
  told({"flyy"}, "`flyy` is not a command of `swiftlet`, did you mean `fly`?\nRun `swiftlet --help`");
  told({"fly", "missions/explore_and_return.xml", "--speeed", "2"},
       "`--speeed` is not an option of `swiftlet fly`, did you mean `--speed`?\nRun `swiftlet fly --help`");
  told({"map", "--jsn"}, "`--jsn` is not an option of `swiftlet map`, did you mean `--json`?");
  told({"map", "a.log", "--odomtry=none"},
       "`--odomtry` is not an option of `swiftlet map`, did you mean `--odometry`?");
  told({"evaluate", "relation", "a", "b"},
       "`relation` is not a command of `swiftlet evaluate`, did you mean `relations`?");
  told({"--verison"}, "`--verison` is not an option of `swiftlet`, did you mean `--version`?");
  told({"doctor", "now"}, "`now` is one argument too many for `swiftlet doctor`");
  told({"help"}, "`help` is not a command of `swiftlet`, `swiftlet --help` helps");
  told({"help", "fly"}, "`help` is not a command of `swiftlet`, `swiftlet fly --help` helps");
  told({"-v"}, "`-v` is not an option of `swiftlet`, did you mean `--version`?");
  told({"hop.xml"}, "`hop.xml` is not a command of `swiftlet`, did you mean `swiftlet fly hop.xml`?");
  told({"nodes", "goto"}, "nodes: unknown node `goto`, `swiftlet nodes` lists all\n");
  told({"evaluate", "hop.xml"}, "`hop.xml` is not a command of `swiftlet evaluate`\n");
  told({"--seed", "7", "fly", "hop.xml"}, "`--seed` is not an option of `swiftlet`, put it behind `fly`");
  told({"fly", "hop.xml", "seed=7"}, "`seed=7` is one argument too many for `swiftlet fly`, did you mean `--seed`?");
  told({"fly", "hop.xml", "\xE2\x80\x93seed", "7"},
       "is one argument too many for `swiftlet fly`, did you mean `--seed`?");
  told({"fly", "hop.xml", "-headless"}, "`-headless` is not an option of `swiftlet fly`, did you mean `--headless`?");
  told({"fly", "hop.xml", "-sped", "2"}, "`-sped` is not an option of `swiftlet fly`, did you mean `--speed`?");
  told({"fly", "hop.xml", "--sped", "2"}, "`--sped` is not an option of `swiftlet fly`, did you mean `--speed`?");
  told({"config", "swiftlet"}, "for `swiftlet config`, did you mean `--system swiftlet`?");
  told({"config", "--system", "swiftlet.yaml"}, "did you mean `swiftlet`?");
  told({"fly", "explore_and_return"}, "did you mean `missions/explore_and_return.xml`?");
  told({"trial", "hall"}, "did you mean `trials/hall.yaml`?");
  told({"fly", "missions"}, "missions: is a folder, and no mission");
  told({"fly", "worlds/unb_case1.sdf"}, "--world worlds/unb_case1.sdf` flies in a world");
  told({"check", "config/systems/swiftlet.yaml"}, "`swiftlet config --system config/systems/swiftlet.yaml` shows it");
  told({"fly", "missions/explore_and_return.xml", "--map", "worlds/unb_case1.sdf"},
       "is a world, and no map, which is a YAML file of map_server, `swiftlet fly MISSION.xml --world "
       "worlds/unb_case1.sdf` flies in a world");
  told({"qqqqqqqqqq"}, "`qqqqqqqqqq` is not a command of `swiftlet`\n");
}

TEST(Usage, AValueThatCannotBeUsedIsToldInPlainWords) {
  const auto told = [](std::vector<std::string> options, const std::string& message) {
    options.insert(options.begin(), {"fly", "missions/explore_and_return.xml"});
    const ProgramEnd end = runSwiftlet(options);
    EXPECT_EQ(end.exit_code, 2) << describe(end);
    EXPECT_THAT(end.err, HasSubstr(message));
  };
  told({"--seed", "-1"}, "--seed: `-1` is not a whole number from 0 to 1000000000");
  told({"--battery", "+-1"}, "--battery: `+-1` is not a number from 0.01 to 1");
  told({"--seed", "1.5"}, "--seed: `1.5` is not a whole number from 0");
  told({"--seed"}, "--seed: a value is missing behind it");
  told({"--seed", "--out", "x"}, "--seed: a value is missing behind it");
  told({"--speed", "MAX"}, "--speed: `MAX` is neither max nor a number from 0.01 to 1000, write `max`");
  told({"--seed", "1", "--seed", "2"}, "--seed: is given more than once");
  told({"--battery", "90%"}, "--battery: `90%` is not a number from 0.01 to 1, write `0.9`: shares are of 1");
  told({"--battery", "0,9"}, "--battery: `0,9` is not a number from 0.01 to 1, write `0.9`");
  told({"--seed", "1,5"}, "from 0 to 1000000000, write a whole number, without points or commas");
  told({"--time-limit", "5min"}, "write the number alone, in the unit that --help names");
  told({"--speed", "2x"}, "--speed: `2x` is neither max nor a number from 0.01 to 1000, write the number alone");
}

}  // namespace
}  // namespace swiftlet::commands
