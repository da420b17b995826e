// A trial that cannot be flown is refused before its first flight, and what earlier flights left stays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <utility>

#include "tests/commands/missions.hpp"
#include "tests/commands/refusals.hpp"
#include "tests/support/program.hpp"

namespace swiftlet::commands {
namespace {

namespace fs = std::filesystem;
using test_support::describe;
using test_support::ProgramEnd;
using test_support::readText;
using test_support::runSwiftlet;
using testing::HasSubstr;

class BadTrial : public RefusalsBeforeWriting {};

TEST_F(BadTrial, ABadTrialOfAFolderIsRefusedBeforeTheFirstFlight) {
  const std::string sound = "mission: missions/explore_and_return.xml\nscenario: {world: worlds/unb_case1.sdf}\n";
  fs::create_directories(path("trials"));
  write("trials/a.yaml", sound);
  for (const auto& [text, pattern] :
       {std::pair{sound + "system: swiftled\n", "did you mean `(config/systems/)?swiftlet"},
        {sound + "name: ../b\n", "b\\.yaml:3:7: name: holds a `/`"},
        {sound + "repeat: 0\n", "b\\.yaml:3:9: repeat: 0 is not within"},
        {"mission: missions/explore_and_return.xml\nscenario: {world: worlds/none.sdf}\n",
         "worlds/none\\.sdf: no such file"}}) {
    write("trials/b.yaml", text);
    expectRefused(runSwiftlet({"trial", path("trials"), "--out", path("run")}), pattern);
  }
}

TEST_F(BadTrial, ATrialWithAMissingMapIsRefusedBeforeAnyFlight) {
  const std::string trial = write("t.yaml",
                                  "mission: missions/find_yourself.xml\nmap: {file: lost.yaml}\n"
                                  "scenario: {world: worlds/unb_case1.sdf}\n");
  expectRefused(runSwiftlet({"trial", trial, "--out", path("run")}),
                "t\\.yaml: trial t: map: lost\\.yaml: no such file");
  write("lost.yaml", "image: nowhere.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n");
  EXPECT_THAT(runSwiftlet({"trial", trial, "--out", path("run")}).err, HasSubstr("nowhere.pgm")) << "beside the trial";
}

TEST_F(BadTrial, ATrialDoesNotReplaceForeignResults) {
  fs::create_directories(path("thesis"));
  write("thesis/report.html", "a thesis");
  const std::string trial = write(
      "t.yaml", "mission: " + write("hop.xml", missionWith(kHop)) + "\nscenario: {world: worlds/unb_case1.sdf}\n");
  expectRefused(runSwiftlet({"trial", trial, "--out", path("thesis")}), "thesis: --out: holds a report or results");
  EXPECT_EQ(readText(path("thesis/report.html")), "a thesis");
}

TEST_F(BadTrial, ARefusedTrialKeepsTheResultsOfTheEarlierOne) {
  const std::string trial = write("t.yaml", "mission: " + write("hop.xml", missionWith(kHop)) +
                                                "\nrepeat: 2\nscenario: {world: worlds/unb_case1.sdf}\n");
  fs::create_directories(path("run/t-002"));
  const std::string results = "{\n  \"trials\": []\n}\n";
  write("run/results.json", results);
  write("run/report.html", "its report");
  write("run/t-002/notes.txt", "mine");
  const ProgramEnd end = runSwiftlet({"trial", trial, "--out", path("run")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("t-002: holds `notes.txt`, which is no file of a run"));
  EXPECT_EQ(readText(path("run/results.json")), results);
  EXPECT_EQ(readText(path("run/report.html")), "its report");
  EXPECT_FALSE(fs::exists(path("run/t-001"))) << "nothing was flown";
}

TEST_F(BadTrial, ConditionsOfTheSameNameAreRefused) {
  const std::string sound = "mission: missions/explore_and_return.xml\nscenario: {world: worlds/unb_case1.sdf}\n";
  for (const auto& [more, name] : {std::pair{"natures: [calm, calm]\n", "t-calm"},
                                   {"batteries: [0.5, 0.5]\n", "t-charge50"},
                                   {"systems: [swiftlet, swiftlet]\n", "t-swiftlet"}})
    expectRefused(runSwiftlet({"trial", write("t.yaml", sound + more), "--out", path("run")}),
                  std::string("two conditions to fly in are named `") + name + "`");
}

}  // namespace
}  // namespace swiftlet::commands
