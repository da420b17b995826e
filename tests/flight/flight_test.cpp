// Flights of the program. Worlds and missions are the shipped ones; the files of a run are checked.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>

#include "tests/flight/run_files.hpp"
#include "tests/flight/tablet.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::flight {
namespace {

namespace fs = std::filesystem;
using test_support::describe;
using test_support::ProgramEnd;
using test_support::ProgramOptions;
using test_support::readText;
using test_support::runSwiftlet;

const std::string kMission = "missions/explore_and_return.xml";

std::vector<std::string> shippedMissions() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(SWIFTLET_SOURCE_DIR) / "missions")) {
    if (entry.path().extension() != ".xml") continue;
    const std::string text = readText(entry.path());
    const auto has = [&](const char* leaf) { return text.find(leaf) != std::string::npos; };
    const bool needs_map = has("<Localize");  // Flown in FlyWithMap.
    // A person, a camera, a target at its place: flown in MissionInItsTrial.
    const bool needs_more =
        has("<FollowMe") || has("<Survey") || has("<Inspect") || has("<ReturnToMe") || has("<LandOnPattern");
    if (has("leave_building=\"true\"")) continue;  // Their worlds are outdoors: flown in their trials.
    const bool needs_camera = has("<LookAround") || has("<ExploreUntilFound");  // Flown in CameraMission.
    if (!needs_map && !needs_more && !needs_camera) names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// A mission that waits for an operator never ends without one.
bool waits(const std::string& mission) {
  return readText(fs::path(SWIFTLET_SOURCE_DIR) / "missions" / (mission + ".xml")).find("<OperatorCommand") !=
         std::string::npos;
}

std::vector<std::string> missionsThat(bool wait) {
  std::vector<std::string> names = shippedMissions();
  names.erase(std::remove_if(names.begin(), names.end(), [&](const auto& name) { return waits(name) != wait; }),
              names.end());
  return names;
}

const auto kByName = [](const auto& mission) { return mission.param; };

class ShippedMission : public test_support::Scratch, public testing::WithParamInterface<std::string> {};

// Scored against the truth, by the bounds of trials/papers/unb_case1.yaml for one flight.
TEST_P(ShippedMission, FliesAccuratelyAndWritesItsRun) {
  const std::string trial = write(GetParam() + ".yaml", "mission: missions/" + GetParam() +
                                                            ".xml\n"
                                                            "time_limit_s: 300\n"
                                                            "criteria:\n"
                                                            "  goal_error_max_m: 0.16\n"
                                                            "  home_error_max_m: 0.16\n"
                                                            "  estimate_rms_max_m: 0.05\n"
                                                            "  map_wall_error_max_m: 0.05\n"
                                                            "scenario: {world: worlds/unb_case1.sdf, seed: 3}\n");
  const ProgramEnd end = runSwiftlet({"trial", trial, "--repeat", "1", "--json", "--out", path("out")});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const auto flight = nlohmann::json::parse(end.out).at("trials").at(0).at("flights").at(0);
  EXPECT_TRUE(flight.at("failures").empty()) << flight.dump(2);
  EXPECT_LE(flight.at("goal_error_m").get<double>(), 0.16);
  EXPECT_LE(flight.at("estimate_rms_m").get<double>(), 0.05);

  const std::string run = path("out/" + GetParam() + "-003");
  expectSoundRun(run);
  const auto mission_json = nlohmann::json::parse(readText(run + "/mission.json"));
  EXPECT_EQ(mission_json.at("outcome"), "done");
  EXPECT_EQ(mission_json.at("mission"), GetParam());
  EXPECT_EQ(mission_json.at("seed"), 3);
  EXPECT_GT(mission_json.at("distance_m").get<double>(), 3.0);
  EXPECT_FALSE(mission_json.at("phases").empty());
  for (const auto& frontier : mission_json.at("frontiers"))
    EXPECT_NE(frontier.at("reason"), "open") << "left without a reason: " << frontier;
}

INSTANTIATE_TEST_SUITE_P(Each, ShippedMission, testing::ValuesIn(missionsThat(false)), kByName);

class WithSmallCamera : public test_support::Scratch {
 protected:
  /// The camera has a quarter of the pixels and a third of the rate, so that a flight takes no longer than one without.
  std::string smallCamera() const {
    const std::string camera =
        write("camera.yaml",
              "name: small\nwidth_px: 160\nheight_px: 120\nrate_hz: 5\nmount: {x_m: 0.12, z_m: 0.03, pitch_deg: 10}\n");
    return write(
        "system.yaml",
        "vehicle: cobra\nlaser: utm_30lx\nrgbd_camera: " + camera +
            "\nautonomy: {estimator: {targets: {classes: [{name: red, hue_deg: 0, saturation_min: 0.55}]}}}\n");
  }
};

class MissionInItsTrial : public WithSmallCamera, public testing::WithParamInterface<std::string> {};

// The criteria of those trials are for many seeds; one flight must be done and touch nothing. It has the laser alone,
// because a flight with the camera takes four times as long, and so no furniture below the laser's plane; only an
// inspection and a landing on a pattern are none without a camera.
TEST_P(MissionInItsTrial, IsFlownToItsEnd) {
  const std::string trials = std::string(SWIFTLET_SOURCE_DIR) + "/trials/", file = GetParam() + ".yaml";
  std::string trial = readText(fs::exists(trials + file) ? trials + file : trials + "papers/" + file);
  const bool sees = GetParam() == "inspect";
  const std::string with_laser = GetParam() == "land_on_pattern" ? "dlr_landing" : "swiftlet";
  if (const std::size_t world = trial.find("unb_map3d.sdf"); !sees && world != std::string::npos)
    trial.replace(world, std::strlen("unb_map3d.sdf"), "unb_case1.sdf");
  const ProgramEnd end =
      runSwiftlet({"trial", write(GetParam() + ".yaml", trial), "--system", sees ? smallCamera() : with_laser, "--seed",
                   "3", "--repeat", "1", "--json", "--out", path("out")});
  ASSERT_LE(end.exit_code, 1) << describe(end);
  const auto flight = nlohmann::json::parse(end.out).at("trials").at(0).at("flights").at(0);
  EXPECT_TRUE(flight.at("mission_done").get<bool>()) << flight.dump(2);
  EXPECT_EQ(flight.at("collisions"), 0) << flight.dump(2);
}

INSTANTIATE_TEST_SUITE_P(Each, MissionInItsTrial,
                         testing::Values("follow_me", "inspect", "survey_floor", "land_on_pattern", "unb_return_to_me"),
                         kByName);

class BareRoom : public WithSmallCamera {
 protected:
  /// A room of 4.4 m by 3.6 m with a red box; the vehicle stands in it with its back to the box.
  std::string room() const {
    const auto box = [](const char* name, const char* pose, const char* size, const char* color) {
      const std::string shape =
          std::string("<pose>") + pose + " 0 0 0</pose><geometry><box><size>" + size + "</size></box></geometry>";
      return std::string("<model name='") + name + "'><static>true</static><link name='body'><collision name='shape'>" +
             shape + "</collision><visual name='shape'>" + shape + "<material><diffuse>" + color +
             " 1</diffuse><swiftlet:texture>blank</swiftlet:texture></material></visual></link></model>";
    };
    return write("room.sdf", "<sdf version='1.9' xmlns:swiftlet='swiftlet'><world name='room'>" +
                                 box("floor", "0 0 -0.05", "4.6 3.8 0.1", "0.5 0.5 0.5") +
                                 box("east", "2.25 0 1.2", "0.1 3.8 2.4", "0.8 0.8 0.7") +
                                 box("west", "-2.25 0 1.2", "0.1 3.8 2.4", "0.7 0.8 0.8") +
                                 box("north", "0 1.85 1.2", "4.6 0.1 2.4", "0.8 0.7 0.8") +
                                 box("south", "0 -1.85 1.2", "4.6 0.1 2.4", "0.8 0.8 0.8") +
                                 box("target", "-1.6 0.9 0.12", "0.24 0.24 0.24", "0.85 0.08 0.08") + "</world></sdf>");
  }
};

class CameraMission : public BareRoom, public testing::WithParamInterface<std::string> {};
using VerticalLaserMission = BareRoom;

// The missions that look for targets find this one within the bound of trials/find_target.yaml.
TEST_P(CameraMission, IsFlownToItsEnd) {
  const bool looks = GetParam() != "map_room_3d";
  const std::string trial =
      write(GetParam() + ".yaml", "mission: missions/" + GetParam() + ".xml\nsystem: " + smallCamera() +
                                      "\ntime_limit_s: 200\n"
                                      "criteria: {" +
                                      (looks ? "targets_found_min: 1, target_error_max_m: 0.10, " : "") +
                                      "false_targets_max: 0, home_error_max_m: 0.16}\n"
                                      "targets: [{model: target, name: red}]\n"
                                      "scenario: {world: " +
                                      room() + ", seed: 3, battery_remaining: 1.0}\n");
  const ProgramEnd end = runSwiftlet({"trial", trial, "--repeat", "1", "--json", "--out", path("out")});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const std::string report = readText(path("out/" + GetParam() + "-003/report.html"));
  EXPECT_THAT(report, testing::HasSubstr("<h2>Targets</h2>")) << "its place";
  EXPECT_EQ(report.find("red_1, from (") != std::string::npos, looks) << "its photograph";
}

INSTANTIATE_TEST_SUITE_P(Each, CameraMission, testing::Values("find_target", "search_and_report", "map_room_3d"),
                         kByName);

// Its own cloud against the true walls. No camera is on board.
TEST_F(VerticalLaserMission, MapsTheRoomInThreeDimensions) {
  const std::string mission =
      write("mission.xml",
            "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Upright\"><Sequence>\n"
            "<TakeOff height_m=\"1.0\"/><Explore/><GoHome/><Land/>\n</Sequence></BehaviorTree></root>\n");
  const std::string trial = write("upright.yaml", "mission: " + mission +
                                                      "\nsystem: swiftlet_vertical_laser\ntime_limit_s: 200\n"
                                                      "criteria: {map3d_error_max_m: 0.08, home_error_max_m: 0.16}\n"
                                                      "scenario: {world: " +
                                                      room() + ", seed: 3, battery_remaining: 1.0}\n");
  const ProgramEnd end = runSwiftlet({"trial", trial, "--repeat", "1", "--json", "--out", path("out")});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const std::string run = path("out/upright-003");
  EXPECT_GT(std::filesystem::file_size(run + "/cloud.ply"), 200'000u);
  EXPECT_GT(std::filesystem::file_size(run + "/map.bt"), 1'000u);
  EXPECT_GT(std::filesystem::file_size(run + "/map.ot"), 1'000u);
  EXPECT_FALSE(std::filesystem::exists(run + "/trajectory_camera.tum")) << "there is no camera";
  EXPECT_THAT(readText(run + "/report.html"), testing::HasSubstr("3D map"));
}

class WaitingMission : public test_support::Scratch, public testing::WithParamInterface<std::string> {};

TEST_P(WaitingMission, IsEndedByTheTimeLimit) {
  const ProgramEnd end = runSwiftlet({"fly", "missions/" + GetParam() + ".xml", "--headless", "--speed", "max",
                                      "--seed", "3", "--json", "--out", path("run"), "--time-limit", "20"});
  ASSERT_EQ(end.exit_code, 1) << describe(end);
  const auto said = nlohmann::json::parse(end.out);
  EXPECT_EQ(said.at("outcome"), "stopped") << said.dump(2);
  EXPECT_EQ(said.at("run"), path("run"));
  expectSoundRun(path("run"));
  EXPECT_FALSE(readTum(path("run/ground_truth.tum")).empty());
  EXPECT_EQ(nlohmann::json::parse(readText(path("run/mission.json"))).at("outcome"), said.at("outcome"));
}

INSTANTIATE_TEST_SUITE_P(Each, WaitingMission, testing::ValuesIn(missionsThat(true)), kByName);

/// A mission of a few leaves in the first world, with one seed.
class ShortMission : public test_support::Scratch {
 protected:
  ProgramEnd fly(const std::string& leaves, const std::string& time_limit_s) {
    const std::string mission =
        write("mission.xml", "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Short\"><Sequence>\n" + leaves +
                                 "\n</Sequence></BehaviorTree></root>\n");
    return runSwiftlet({"fly", mission, "--headless", "--speed", "max", "--seed", "1", "--json", "--out", path("run"),
                        "--time-limit", time_limit_s});
  }
  nlohmann::json missionJson() const { return nlohmann::json::parse(readText(path("run/mission.json"))); }
};

// A part of the first room: a frontier beyond it is left and reported as out of bounds, for every seed.
TEST_F(ShortMission, ReportsFrontiersOutsideItsBoundsAsLeft) {
  constexpr double kEast_m = 3.0, kSouth_m = -3.0;
  const ProgramEnd end = fly("<TakeOff/><Explore bounds=\"-3;-3;3;4\"/><GoHome/><Land/>", "300");
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  int out_of_bounds = 0;
  const auto mission_json = missionJson();
  for (const auto& frontier : mission_json.at("frontiers")) {
    EXPECT_NE(frontier.at("reason"), "open") << frontier;
    if (frontier.at("reason") != "out of bounds") continue;
    ++out_of_bounds;
    EXPECT_TRUE(frontier.at("x_m").get<double>() > kEast_m || frontier.at("y_m").get<double>() < kSouth_m) << frontier;
  }
  EXPECT_GE(out_of_bounds, 1);
}

// No person blocks a path, so it does not wait for a minute.
TEST_F(ShortMission, AGoalNeverSeenFailsAtOnce) {
  const ProgramEnd end = fly("<TakeOff/><MoveToGoal goal=\"40.0;40.0;1.0\"/><Land/>", "60");
  ASSERT_EQ(end.exit_code, 1) << describe(end);
  const auto events = readText(path("run/events.jsonl"));
  EXPECT_NE(events.find("is outside the map"), std::string::npos) << events;
  EXPECT_EQ(events.find("goes aside"), std::string::npos) << events;
  EXPECT_LT(missionJson().at("mission_time_s").get<double>(), 15.0);
}

TEST_F(ShortMission, ExploringFailsWithoutRoomToMove) {
  const ProgramEnd end = fly("<TakeOff/><Explore clearance_m=\"1.9\"/><Land/>", "120");
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  const auto mission_json = missionJson();
  EXPECT_EQ(mission_json.at("outcome"), "failed") << mission_json.dump(2);
  EXPECT_THAT(mission_json.at("reason").get<std::string>(), testing::HasSubstr("shut in"));
}

class Determinism : public test_support::Scratch {
 protected:
  ProgramEnd fly(const std::string& run, const std::string& seed, std::vector<std::string> more,
                 const ProgramOptions& options = {}) {
    std::vector<std::string> arguments = {"fly", kMission, "--speed", "max",          "--seed",
                                          seed,  "--out",  path(run), "--time-limit", time_limit_s_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runSwiftlet(arguments, options);
  }
  void expectSame(const std::string& a, const std::string& b) const {
    for (const std::string name : {"/trajectory.tum", "/map.pgm", "/events.jsonl"})
      EXPECT_TRUE(readText(path(a + name)) == readText(path(b + name))) << a << " and " << b << " differ in " << name;
  }
  /// Flies with a tablet that watches.
  void flyWatched(const std::string& run, const std::string& seed, std::vector<std::string> more) {
    std::unique_ptr<Tablet> tablet;
    ProgramOptions options;
    options.while_running = [&](pid_t, const std::string& out) {
      const auto address = out.find("http://127.0.0.1:");
      if (!tablet && address != std::string::npos && out.find('\n', address) != std::string::npos)
        tablet = std::make_unique<Tablet>(std::stoi(out.substr(address + 17)));
    };
    more.insert(more.end(), {"--port", "0"});
    const ProgramEnd end = fly(run, seed, std::move(more), options);
    ASSERT_TRUE(tablet) << describe(end);
    EXPECT_GT(tablet->frames(), 3) << describe(end);
  }

  std::string time_limit_s_ = "40";
};

TEST_F(Determinism, TheSameSeedLeavesTheSameBytes) {
  const ProgramEnd first = fly("first", "11", {"--headless"});
  ASSERT_GE(readTum(path("first/trajectory.tum")).size(), 500u) << describe(first);
  fly("second", "11", {"--headless"});
  expectSame("first", "second");
  const auto said = nlohmann::json::parse(readText(path("first/mission.json")));
  EXPECT_EQ(said.at("nature"), "real") << "without --nature";
  EXPECT_EQ(readText(path("first/nature.yaml")), readText(path("second/nature.yaml")));
  fly("drawn", "11", {"--headless", "--nature", path("first/nature.yaml")});
  expectSame("first", "drawn");
  fly("other", "12", {"--headless"});
  EXPECT_FALSE(readText(path("first/trajectory.tum")) == readText(path("other/trajectory.tum")))
      << "the seed is ignored";
}

TEST_F(Determinism, AWatchingTabletChangesNothing) {
  fly("alone", "11", {"--headless"});
  flyWatched("watched", "11", {});
  expectSame("alone", "watched");
}

TEST_F(Determinism, AWatchingTabletChangesNothingWithACamera) {
  time_limit_s_ = "7";
  fly("alone", "11", {"--system", "swiftlet_3d", "--headless"});
  flyWatched("watched", "11", {"--system", "swiftlet_3d"});
  expectSame("alone", "watched");
  for (const std::string name : {"/trajectory_camera.tum", "/map.ot", "/cloud.ply"}) {
    EXPECT_GT(readText(path("alone" + name)).size(), 1000u) << name;
    EXPECT_TRUE(readText(path("alone" + name)) == readText(path("watched" + name))) << name;
  }
}

class CutShort : public test_support::Scratch {
 protected:
  /// Flies until trajectory.tum holds `bytes`, then sends the signal; the second one as soon as the first is answered.
  ProgramEnd flyAndSend(int signal, std::uintmax_t bytes, bool twice = false) {
    bool sent = false, sent_again = false;
    ProgramOptions options;
    options.while_running = [&, signal, bytes](pid_t process, const std::string& out) {
      if (twice && sent && !sent_again && out.find("asked to end: landing") != std::string::npos) {
        sent_again = true;
        kill(process, signal);
      }
      std::error_code missing;
      const auto size = fs::file_size(path("run/trajectory.tum"), missing);
      if (sent || missing || size < bytes || !fs::exists(path("run/report.html"))) return;
      sent = true;
      kill(process, signal);
    };
    ProgramEnd end =
        runSwiftlet({"fly", kMission, "--headless", "--speed", "4", "--seed", "5", "--out", path("run")}, options);
    EXPECT_TRUE(sent) << "the flight was over before it could be cut short: " << describe(end);
    return end;
  }
};

TEST_F(CutShort, AKilledProcessLeavesAReadableRun) {
  const ProgramEnd end = flyAndSend(SIGKILL, 40'000);
  EXPECT_EQ(end.signal, SIGKILL) << describe(end);
  expectSoundRun(path("run"));
  EXPECT_EQ(nlohmann::json::parse(readText(path("run/mission.json"))).at("outcome"), "flying");
}

TEST_F(CutShort, AnInterruptLandsAndEndsTheRunCleanly) {
  const ProgramEnd end = flyAndSend(SIGINT, 20'000);
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  expectSoundRun(path("run"));
  const auto mission = nlohmann::json::parse(readText(path("run/mission.json")));
  EXPECT_EQ(mission.at("outcome"), "stopped");
  EXPECT_EQ(mission.at("reason"), "landed: the operator asked for it");
  EXPECT_LT(readTum(path("run/trajectory.tum")).back().position_m[2], 0.25) << "it stands on the floor";
}

TEST_F(CutShort, ASecondTerminationStopsAtOnce) {
  const ProgramEnd end = flyAndSend(SIGTERM, 20'000, true);
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  expectSoundRun(path("run"));
  const auto mission = nlohmann::json::parse(readText(path("run/mission.json")));
  EXPECT_EQ(mission.at("outcome"), "stopped");
  EXPECT_EQ(mission.at("reason"), "stopped from outside");
}

TEST_F(CutShort, TerminationKeepsTheFinishedFlightsOfATrial) {
  ProgramOptions options;
  options.while_running = [&](pid_t process, const std::string& out) {
    if (out.find('\n') != std::string::npos) kill(process, SIGTERM);  // After the first flight's line.
  };
  const std::string trial =
      write("short.yaml", "mission: " + kMission + "\ntime_limit_s: 5\nscenario: {world: worlds/unb_case1.sdf}\n");
  const ProgramEnd end = runSwiftlet({"trial", trial, "--repeat", "1000", "--out", path("out")}, options);
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  const auto flights = nlohmann::json::parse(readText(path("out/results.json"))).at("trials").at(0).at("flights");
  EXPECT_GE(flights.size(), 1u);
  EXPECT_LT(flights.size(), 1000u);
}

TEST_F(CutShort, AnOlderRunIsReplacedCompletely) {
  const std::vector<std::string> fly = {"fly",          kMission, "--headless", "--speed",  "max",
                                        "--time-limit", "8",      "--out",      path("run")};
  runSwiftlet(fly);
  const auto poses = readTum(path("run/trajectory.tum")).size();
  runSwiftlet(fly);
  expectSoundRun(path("run"));
  EXPECT_EQ(readTum(path("run/trajectory.tum")).size(), poses);
}

}  // namespace
}  // namespace swiftlet::flight
