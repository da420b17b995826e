// swiftlet check with warnings and dry runs, and swiftlet migrate, as users meet them.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/commands/missions.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::runSwiftlet;
using testing::HasSubstr;
using testing::StartsWith;

class CheckMission : public test_support::Scratch {};

TEST_F(CheckMission, WarnsWithThePathAndStillPasses) {
  const std::string path = write("mission.xml", missionWith("      <TakeOff/>\n      <GoHome/>\n"));
  const ProgramEnd end = runSwiftlet({"check", path});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_EQ(end.err,
            path + ":3:5: warning: Sequence: the mission never lands, end it with a <Land/> [Main/Sequence]\n");
  EXPECT_EQ(end.out, "1 mission is sound, with 1 warning\n");
  const auto json = nlohmann::json::parse(runSwiftlet({"check", "--json", path}).out);
  EXPECT_TRUE(json["problems"].empty());
  EXPECT_EQ(json["warnings"][0]["path"], "Main/Sequence");
  EXPECT_EQ(json["warnings"][0]["line"], 3);
  EXPECT_EQ(json["warnings"][0]["code"], "mission.no-landing");
}

TEST_F(CheckMission, ProblemsHaveThePathToo) {
  const std::string path = write("mission.xml", missionWith("      <TakeOff height_m=\"-1\"/>\n      <Land/>\n"));
  const ProgramEnd end = runSwiftlet({"check", path});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr(":4:16: TakeOff.height_m: `-1` is out of range, expected a number in metres from 0.3 "
                                 "to 100 [Main/Sequence/TakeOff]\n"));
}

TEST_F(CheckMission, AMissionThatIsNotThereHasItsCodeToo) {
  const auto json = nlohmann::json::parse(runSwiftlet({"check", "--json", path("none.xml")}).out);
  EXPECT_EQ(json["problems"][0]["code"], "file.missing");
}

TEST_F(CheckMission, ADryRunTellsWhatHappens) {
  const std::string mission = write("mission.xml", missionWith(kHop));
  const std::string script = write("hop.script", "TakeOff: RUNNING x2, SUCCESS\n");
  const ProgramEnd end = runSwiftlet({"check", "--dry-run", script, mission});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_EQ(end.out,
            "1 mission is sound\n"
            "not in the script: Main/Sequence/Land: SUCCESS\n"
            "tick 1, 0.10 s: RUNNING\n"
            "  Main/Sequence/TakeOff: IDLE -> RUNNING\n"
            "  Main/Sequence: IDLE -> RUNNING\n"
            "tick 2, 0.20 s: RUNNING\n"
            "tick 3, 0.30 s: SUCCESS\n"
            "  Main/Sequence/TakeOff: RUNNING -> SUCCESS\n"
            "  Main/Sequence/Land: IDLE -> SUCCESS\n"
            "  Main/Sequence: RUNNING -> SUCCESS\n"
            "ended with SUCCESS after 3 ticks\n");
  const auto json = nlohmann::json::parse(runSwiftlet({"check", "--json", "--dry-run", script, mission}).out);
  EXPECT_EQ(json["ticks"].size(), 3U);
  EXPECT_EQ(json["ticks"][2]["answer"], "SUCCESS");
}

TEST_F(CheckMission, ADryRunOfTheShippedPatrolComesHomeWhenTheBatteryIsLow) {
  const std::string script = write("patrol.script", "Patrol: RUNNING\nIsBatteryLow: false x4, true\n");
  const ProgramEnd end = runSwiftlet({"check", "--dry-run", script, "missions/patrol.xml"});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("tick 5, 0.50 s: SUCCESS\n"));
  EXPECT_THAT(end.out, HasSubstr("Patrol: RUNNING -> IDLE"));
}

TEST_F(CheckMission, AScriptThatDoesNotFitIsRefused) {
  const std::string mission = write("mission.xml", missionWith(kHop));
  const std::string script = write("hop.script", "# x\nTakeof: SUCCESS\n");
  const ProgramEnd end = runSwiftlet({"check", "--dry-run", script, mission});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_EQ(end.err, script + ":2:1: Takeof: the mission has no such leaf, did you mean `TakeOff`?\n");
  EXPECT_EQ(runSwiftlet({"check", "--dry-run", script, mission, mission}).exit_code, 2);
  EXPECT_EQ(runSwiftlet({"check", "--dry-run", path("none"), mission}).exit_code, 2);
}

TEST_F(CheckMission, TheExitCodeOfADryRunSaysHowItEnded) {
  const std::string mission = write("mission.xml", missionWith(kHop));
  const auto codeOf = [&](const std::string& script, bool json) {
    std::vector<std::string> arguments = {"check", "--dry-run", write("s.script", script), mission};
    if (json) arguments.push_back("--json");
    return runSwiftlet(arguments).exit_code;
  };
  for (const bool json : {false, true}) {
    EXPECT_EQ(codeOf("TakeOff: SUCCESS\n", json), 0);
    EXPECT_EQ(codeOf("TakeOff: FAILURE\n", json), 1);
    EXPECT_EQ(codeOf("TakeOff: RUNNING\nticks: 3\n", json), 1);
  }
}

TEST_F(CheckMission, ANameWithALineEndStaysInItsLine) {
  const std::string path = write("m.xml", missionWith("      <TakeOff name=\"a&#10;b\" x=\"1\"/>\n      <Land/>\n"));
  const ProgramEnd end = runSwiftlet({"check", path});
  EXPECT_THAT(end.err, HasSubstr("[Main/Sequence/a\\nb]\n"));
  EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << describe(end);
}

TEST_F(CheckMission, AMissionThatIsNotSoundHasNoDryRun) {
  const std::string mission = write("mission.xml", missionWith("      <Land/>\n"));
  const ProgramEnd end = runSwiftlet({"check", "--dry-run", write("s", "Land: SUCCESS"), mission});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("expected a TakeOff before it"));
}

TEST_F(CheckMission, WithoutThePageItWarnsOfWhatWaitsForAnOperator) {
  const std::string mission =
      write("m.xml", missionWith("      <TakeOff/>\n      <WaitForOperator/>\n      <Land/>\n"));
  EXPECT_EQ(runSwiftlet({"check", mission}).err, "");
  const ProgramEnd end = runSwiftlet({"check", "--headless", mission});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.err, HasSubstr(":5:7: warning: WaitForOperator: nobody says `go on`, and it waits without an end"));
  const ProgramEnd flight = runSwiftlet({"fly", "--headless", "--time-limit", "0.1", "--out", path("run"), mission});
  EXPECT_THAT(flight.err, HasSubstr("warning: WaitForOperator: nobody says `go on`"));
  const std::string trial = "mission: " + mission + "\ntime_limit_s: 1\nscenario: {world: worlds/unb_case1.sdf}\n";
  EXPECT_THAT(runSwiftlet({"trial", write("t.yaml", trial), "--out", path("t")}).err,
              HasSubstr("warning: WaitForOperator: nobody says `go on`"));
  const std::string with_operator = trial + "operator: [{command: go_on, at_s: 0.01, expect: any}]\n";
  EXPECT_THAT(runSwiftlet({"trial", write("t.yaml", with_operator), "--out", path("t")}).err,
              testing::Not(HasSubstr("warning")));
}

TEST_F(CheckMission, AFileOfAnotherKindIsToldInALine) {
  const std::string mission = write("m.xml", missionWith(kHop));
  const std::string trial = write("t.yaml", "mission: " + mission + "\nscenario: {world: worlds/unb_case1.sdf}\n");
  const auto expectLine = [](const std::vector<std::string>& arguments, const std::string& line) {
    const ProgramEnd end = runSwiftlet(arguments);
    EXPECT_EQ(end.exit_code, 2) << describe(end);
    EXPECT_EQ(end.err, line + "\n");
  };
  const std::string no_trial =
      mission + ": is a mission, and no trial, which is a YAML file, `swiftlet fly " + mission + "` flies a mission";
  const std::string no_mission =
      trial + ": is a trial, and no mission, which is an XML file, `swiftlet trial " + trial + "` flies a trial";
  expectLine({"trial", mission}, no_trial);
  expectLine({"trial", "--envelope", mission}, no_trial);
  expectLine({"fly", mission, "--scenario", mission}, no_trial);
  expectLine({"check", trial}, no_mission);
  expectLine({"fly", trial}, no_mission);
  expectLine({"migrate", trial}, no_mission);
  const auto is = [](const std::string& file, const std::string& what, const std::string& no) {
    return file + ": is " + what + ", and no " + no;
  };
  const std::string fly_mission = "`swiftlet fly " + mission + "` flies a mission";
  const std::string fly_trial = "`swiftlet trial " + trial + "` flies a trial";
  const std::string no_profile = is(mission, "a mission", "profile, which is a YAML file, ") + fly_mission;
  expectLine({"check", "--system", mission, mission}, no_profile);
  expectLine({"config", "--system", mission}, no_profile);
  expectLine({"fly", mission, "--headless", "--world", trial},
             is(trial, "a trial", "world, which is a file of SDF, ") + fly_trial);
  expectLine({"fly", mission, "--headless", "--map", trial},
             is(trial, "a trial", "map, which is a YAML file of map_server, ") + fly_trial);
  expectLine({"localize", mission, trial},
             is(mission, "a mission", "map, which is a YAML file of map_server, ") + fly_mission);
  const std::string world = write("w.xml", "<?xml version='1.0'?>\n<sdf version='1.9'></sdf>\n");
  expectLine({"check", world},
             is(world, "a world", "mission, which is an XML file, `swiftlet fly MISSION.xml --world ") + world +
                 "` flies in a world");
}

class Migrating : public test_support::Scratch {
 protected:
  const std::string old_ =
      "<root main_tree_to_execute=\"M\">\n  <!-- as before -->\n  <BehaviorTree ID=\"M\">\n    <SequenceStar>\n      "
      "<TakeOff/>\n      <Land/>\n    </SequenceStar>\n  </BehaviorTree>\n</root>\n";
  const std::string new_ =
      "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">\n  <!-- as before -->\n  <BehaviorTree ID=\"M\">\n    "
      "<SequenceWithMemory>\n      <TakeOff/>\n      <Land/>\n    </SequenceWithMemory>\n  </BehaviorTree>\n</root>\n";
};

TEST_F(Migrating, MakesAMissionThatCheckFindsSound) {
  const std::string from = write("old.xml", old_);
  const ProgramEnd before = runSwiftlet({"check", from});
  EXPECT_EQ(before.exit_code, 2) << describe(before);
  EXPECT_THAT(before.err, HasSubstr("`swiftlet migrate " + from + "` rewrites it"));
  const ProgramEnd end = runSwiftlet({"migrate", from, "--out", path("new.xml")});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_EQ(test_support::readText(path("new.xml")), new_);
  EXPECT_THAT(end.err, HasSubstr("old.xml:4:5: SequenceStar: `SequenceStar` is of version 3, version 4 writes "
                                 "`SequenceWithMemory`\n"));
  const ProgramEnd after = runSwiftlet({"check", path("new.xml")});
  EXPECT_EQ(after.exit_code, 0) << describe(after);
  EXPECT_EQ(after.err, "");
}

TEST_F(Migrating, FindsItsFileWhereMissionsAre) {
  test_support::ProgramOptions elsewhere;
  elsewhere.working_folder = folder_.string();
  const ProgramEnd end = runSwiftlet({"migrate", "missions/explore_and_return.xml"}, elsewhere);
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("it is of version 4 already"));
  const ProgramEnd missing = runSwiftlet({"migrate", "mission/explore_and_return.xml"}, elsewhere);
  EXPECT_EQ(missing.exit_code, 2) << describe(missing);
  EXPECT_THAT(missing.err, HasSubstr("did you mean `missions/explore_and_return.xml`?"));
}

TEST_F(Migrating, PrintsTheFileAlone) {
  EXPECT_EQ(runSwiftlet({"migrate", write("old.xml", old_)}).out, new_);
  const ProgramEnd again = runSwiftlet({"migrate", write("new.xml", new_)});
  EXPECT_EQ(again.out, new_);
  EXPECT_THAT(again.err, HasSubstr("it is of version 4 already"));
}

TEST_F(Migrating, OverItselfLosesNothingWhenItCannotBeRead) {
  const std::string broken = write("broken.xml", "<root><BehaviorTree>");
  const ProgramEnd end = runSwiftlet({"migrate", broken, "--out", broken});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, StartsWith(broken + ":1:21: <BehaviorTree>: malformed XML"));
  EXPECT_EQ(test_support::readText(broken), "<root><BehaviorTree>");
}

}  // namespace
}  // namespace swiftlet::commands
