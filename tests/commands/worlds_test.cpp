// Worlds are found by the names that people give, and a start that is given counts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/commands/refusals.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::runSwiftlet;

const std::string kMission = "missions/explore_and_return.xml";

class Worlds : public RefusalsBeforeWriting {
 protected:
  ProgramEnd fly(std::vector<std::string> options) {
    options.insert(options.begin(), {"fly", kMission, "--headless", "--out", path("run")});
    return runSwiftlet(options);
  }
  static void expectBadStart(const ProgramEnd& end) {
    Refusals::expectRefused(end, "--start: `.*` is not a place x;y;yaw");
  }
};

TEST_F(Worlds, AreFoundByTheirNames) {
  for (const std::string name : {"unb_case1", "unb_case1.sdf", "worlds/unb_case1"})
    expectRefused(fly({"--world", name, "--start", "900;0;0"}),
                  "unb_case1\\.sdf:[0-9]+: start: at \\(900\\.00, 0\\.00");
  expectRefused(fly({"--world", "unb_case"}), "unb_case: no such file.*did you mean `worlds/unb_case1.sdf`");
  expectRefused(fly({"--world", "Unb_Case1"}), "did you mean `worlds/unb_case1.sdf`");
  expectRefused(fly({"--world", "hall"}), "did you mean `trials/worlds/hall.sdf`");
}

TEST_F(Worlds, AStartInsideAThingNamesTheNearestFreePlaceWhichWillDo) {
  const ProgramEnd end = fly({"--start", "0;0;0"});
  expectRefused(end, "start: at \\(0\\.00, 0\\.00, 0\\.00\\) .*the nearest free place is --start \"");
  const std::size_t begin = end.err.find("--start \"") + 9;
  const ProgramEnd flown =
      fly({"--start", end.err.substr(begin, end.err.find('"', begin) - begin), "--time-limit", "0.5"});
  EXPECT_NE(flown.exit_code, 2) << describe(flown);
  for (const std::string text : {"here", "1;2;3;4;5", "nan;0;0", "1,5;2;90", "3,5;2", "3,5 2", "1;2;", "1;2;3;20000"})
    expectBadStart(fly({"--start", text}));
}

TEST_F(Worlds, ATrialsWorldAndMissionAreFoundBesideItsFile) {
  write("room.sdf",
        "<sdf version='1.9'><world name='w'><model name='pillar'><static>1</static><link name='l'><collision "
        "name='c'><geometry><box><size>1 1 9</size></box></geometry></collision></link></model></world></sdf>");
  write("hop.xml", test_support::readText(std::filesystem::path(SWIFTLET_SOURCE_DIR) / kMission));
  const std::string trial = write("t.yaml", "mission: hop.xml\nscenario: {world: room.sdf}\n");
  expectRefused(runSwiftlet({"trial", trial, "--out", path("other")}), "room\\.sdf:1.*`pillar/l`");
  write("s.yaml", "based_on: swiftlet\n");
  const std::string bare = write("u.yaml", "mission: ./hop\nsystem: s.yaml\nscenario: {world: room}\n");
  expectRefused(runSwiftlet({"trial", bare, "--out", path("other")}), "room\\.sdf:1.*`pillar/l`");
}

TEST_F(Worlds, FoldersOfModelsThatAreNotThereAreRefused) {
  std::filesystem::create_directories(path("my_models"));
  write("my_models/readme.txt", "");
  const std::string folder = path("my_models");
  expectRefused(fly({"--model-path", path("my_modles")}),
                "--model-path: there is no folder `.*my_modles`, did you mean `" + folder + "`");
  expectRefused(fly({"--model-path", path("my_modles/kitchen/")}), "did you mean `" + folder + "`");
  expectRefused(fly({"--model-path", path("my_models/readme.txt")}), "readme.txt: --model-path: is not a folder");
  expectRefused(fly({"--model-path", ""}), "--model-path: there is no folder");
  expectRefused(fly({"--model-path", folder, "--start", "900;0;0"}), "start: at \\(900\\.00");
  const std::string trial = "mission: " + kMission + "\nscenario: {world: worlds/unb_case1.sdf, ";
  expectRefused(runSwiftlet({"trial", write("t.yaml", trial + "model_paths: [my_model]}\n"), "--out", path("run")}),
                "trial t: scenario.model_paths: there is no folder `my_model` in .*did you mean `my_models`");
  expectRefused(runSwiftlet({"trial", write("t.yaml", trial + "model_paths: [" + path("my_model") + "]}\n"), "--out",
                             path("run")}),
                "scenario.model_paths: there is no folder `.*my_model`, did you mean `" + folder + "`");
}

}  // namespace
}  // namespace swiftlet::commands
