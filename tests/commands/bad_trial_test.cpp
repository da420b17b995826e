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
        {sound + "natures: [calm, real]\nsystem: swiftled\n",
         "b\\.yaml:4:9: system: .*swiftled.yaml: no such file.*did you mean `swiftlet`"},
        {sound + "name: ../b\n", "b\\.yaml:3:7: name: holds a `/`"},
        {sound + "repeat: 0\n", "b\\.yaml:3:9: repeat: 0 is not within"},
        {"mission: missions/explore_and_return.xml\nscenario: {world: worlds/none.sdf}\n",
         "b\\.yaml:2:19: scenario\\.world: worlds/none\\.sdf: no such file"}}) {
    write("trials/b.yaml", text);
    expectRefused(runSwiftlet({"trial", path("trials"), "--out", path("run")}), pattern);
  }
}

/// The kind of a file is told by its keys, wherever they are in it and however it is encoded.
TEST_F(BadTrial, ALargeFileOrOneInUtf16IsToldByItsKeys) {
  const std::string text =
      std::string(1 << 21, '#') +
      "\nmission: missions/explore_and_return.xml\nsystem: swiftled\nscenario: {world: worlds/unb_case1.sdf}\n";
  std::string utf16 = "\xff\xfe";
  for (const char letter : std::string("mission: missions/explore_and_return.xml\r\nsystem: swiftled\r\n"
                                       "scenario: {world: worlds/unb_case1.sdf}\r\n"))
    utf16 += {letter, '\0'};
  expectRefused(runSwiftlet({"trial", write("t.yaml", text), "--out", path("run")}), "t\\.yaml:3:9: system: ");
  const std::string narrow = write("u.yaml", utf16);
  expectRefused(runSwiftlet({"trial", narrow, "--out", path("run")}), "u\\.yaml:2:9: system: ");
  expectRefused(runSwiftlet({"fly", narrow, "--headless", "--out", path("run")}), "is a trial, and no mission");
}

TEST_F(BadTrial, ATrialWithAMissingMapIsRefusedBeforeAnyFlight) {
  const std::string trial = write("t.yaml",
                                  "mission: missions/find_yourself.xml\nmap: {file: lost.yaml}\n"
                                  "scenario: {world: worlds/unb_case1.sdf}\n");
  expectRefused(runSwiftlet({"trial", trial, "--out", path("run")}),
                "t\\.yaml:2:13: map\\.file: lost\\.yaml: no such file in .* or this folder");
  write("lost.yaml", "image: nowhere.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n");
  EXPECT_THAT(runSwiftlet({"trial", trial, "--out", path("run")}).err, HasSubstr("nowhere.pgm")) << "beside the trial";
}

/// Each message names the line of the trial, the folder of the trial among those that were looked at, and the file
/// beside it that was probably meant.
TEST_F(BadTrial, AMissingFileIsToldWhereTheTrialNamesIt) {
  fs::create_directories(path("mine"));
  const std::string mission = "mission: hop_there.xml\n", world = "scenario: {world: my_hall.sdf}\n";
  write("mine/hop_there.xml", missionWith(kHop));
  write("mine/my_hall.sdf", "<sdf version='1.9'><world name='w'/></sdf>");
  write("mine/my_system.yaml", "based_on: swiftlet\n");
  write("mine/my_map.yaml", "image: none.pgm\n");
  const std::string in_folder = ": no such file in " + path("mine") + " or this folder or .*did you mean `";
  for (const auto& [text, pattern] :
       {std::pair{"mission: hop_their.xml\n" + world,
                  "t.yaml:1:10: mission: hop_their.xml" + in_folder + "hop_there.xml`"},
        {mission + "scenario: {world: my_hal.sdf}\n",
         "t.yaml:2:19: scenario.world: my_hal.sdf" + in_folder + "my_hall.sdf`"},
        {mission + world + "system: ./my_sistem.yaml\n", "t.yaml:3:9: system: ./my_sistem.yaml" + in_folder},
        {mission + world + "system: my_system\n",
         "t.yaml:3:9: system: config/systems/my_system.yaml: .*did you mean `my_system.yaml`"},
        {"mission: t.yaml\n" + world, "t.yaml:1:10: mission: .*t.yaml: is a trial, and no mission"},
        {"mission: missions/hop_there.xml\n" + world,
         "t.yaml:1:10: .*missions/hop_there.xml: .*did you mean `hop_there.xml`"},
        {mission + world + "map: {file: my_mab.yaml}\n",
         "t.yaml:3:13: map.file: my_mab.yaml" + in_folder + "my_map.yaml`"},
        {mission + "scenario: {world: my_hall.sdf, vehicles: [{name: a, mission: hob.xml}, {name: b}]}\n",
         "t.yaml:2:[0-9]+: scenario.vehicles.0..mission: hob.xml: no such file in " + path("mine")}})
    expectRefused(runSwiftlet({"trial", write("mine/t.yaml", text), "--out", path("run")}), pattern);
  expectRefused(runSwiftlet({"trial", write("mine/t.yaml", mission + world), "--system", "my_sistem"}),
                "config/systems/my_sistem.yaml: no such file");
}

/// They are found, so that something else is refused.
TEST_F(BadTrial, FilesMayBeNamedByTheirAddress) {
  fs::create_directories(path("my files"));
  write("my files/hop.xml", missionWith(kHop));
  write("my files/hall.sdf", "<sdf version='1.9'><world name='w'/></sdf>");
  write("my files/map.yaml", "image: none.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n");
  const std::string folder = "file://" + path("my%20files/");
  const std::string trial = write("t.yaml", "mission: " + folder + "hop.xml\nmap: {file: '" + folder +
                                                "map.yaml'}\nscenario: {world: '" + folder + "hall.sdf'}\n");
  Refusals::expectRefused(runSwiftlet({"trial", trial, "--out", path("run")}), "map.yaml:1:8: image: .*none.pgm");
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
