// The folder of a run, for every end of the run.
#include "interfaces/run_folder.hpp"

#include <csignal>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "common/topological_map.hpp"
#include "interfaces/files/json_lines.hpp"
#include "interfaces/files/map_server.hpp"
#include "interfaces/files/tum.hpp"
#include "support.hpp"
#include "tests/support/layers.hpp"

namespace swiftlet::interfaces {
namespace {

using common::FrontierReason;
using common::MissionState;
using common::Severity;
using common::Time;
using nlohmann::json;
using testing::HasSubstr;

const RunInfo kInfo{.mission = "explore_and_return",
                    .mission_file = "missions/explore_and_return.xml",
                    .world = "worlds/unb_case1.sdf",
                    .system = "swiftlet",
                    .seed = 7,
                    .started = "2025-01-31 14:05:09"};
const std::string kPng = "\x89PNG not really";

/// A flight along x at 1 m/s; the map grows with it.
struct Flight {
  common::OccupancyGrid grid = common::makeOccupancyGrid(0.05);
  double time_s = 0.0;

  common::VehicleState state() const {
    common::VehicleState state;
    state.stamp = Time::fromSeconds(time_s);
    state.T_odom_body.position_m = {time_s, 0.0, 1.0};
    state.velocity_odom_m_s = {1.0, 0.0, 0.0};
    state.T_map_odom = {0.0, 0.5, 0.0};
    return state;
  }

  test::Layers layers(MissionState mission, const std::string& phase) {
    grid.set(grid.cellAt(time_s, 0.0), -10);
    grid.set(grid.cellAt(time_s, 1.0), 10);
    test::Layers layers;
    layers.stamp = Time::fromSeconds(time_s);
    layers.vehicle.state = state();
    layers.vehicle.distance_flown_m = time_s;
    layers.energy.battery_remaining = 0.5;
    layers.map.grid = std::make_shared<common::OccupancyGrid>(grid.snapshot());
    common::Frontier frontier;
    frontier.centroid_map_m = {1.5, -2.0};
    frontier.length_m = 0.3;
    frontier.reason = FrontierReason::kUnreachable;
    frontier.explanation = "unreachable at clearance 0.10 m";
    layers.map.frontiers = std::make_shared<std::vector<common::Frontier>>(1, frontier);
    layers.map.explored_area_m2 = 12.5;
    layers.mission.status.state = mission;
    layers.mission.status.phase = phase;
    return layers;
  }
  common::World world(MissionState mission, const std::string& phase) { return layers(mission, phase).world(); }

  /// Writes 10 s of the flight: two phases, estimates at 100 Hz, snapshots at 10 Hz.
  void flyInto(RunFolder& run) {
    for (int tick = 0; tick <= 1000; ++tick) {
      time_s = 0.01 * tick;
      run.state(state());
      if (tick % 10 != 0) continue;
      const MissionState mission = time_s < 1 ? MissionState::kReady : MissionState::kRunning;
      run.world(world(mission, time_s < 1 ? "" : time_s < 4 ? "take off" : "explore"));
    }
    run.world(world(MissionState::kDone, ""));
  }
};

TEST(RunFolder, APhaseNamesWhatFliesAndWhy) {
  const ScratchFolder folder;
  RunFolder run(folder.path() / "run", kInfo, "");
  Flight flight;
  run.world(flight.world(MissionState::kRunning, "explore"));
  test::Layers home = flight.layers(MissionState::kHeld, "fly home");
  home.mission.status.flown_by = common::FlownBy::kSupervisor;
  home.mission.status.reason = "turned back with 28 % of the battery left";
  home.stamp = Time::fromSeconds(5);
  run.world(home.world());
  run.finish({});
  const json phases = json::parse(bytesOf(folder / "run/mission.json"))["phases"];
  ASSERT_EQ(phases.size(), 2u);
  EXPECT_EQ(phases[0]["flown_by"], "mission");
  EXPECT_EQ(phases[1]["name"], "fly home");
  EXPECT_EQ(phases[1]["flown_by"], "supervisor");
  EXPECT_EQ(phases[1]["reason"], "turned back with 28 % of the battery left");
  EXPECT_THAT(bytesOf(folder / "run/report.html"), HasSubstr("turned back with 28 %"));
}

TEST(RunFolder, KeepsTheMapsAndPhotographsOfTheMissionAndANewRunRemovesThem) {
  const ScratchFolder folder;
  {
    RunFolder run(folder.path() / "run", kInfo, "");
    Flight flight;
    run.saveMap("hall", *flight.layers(MissionState::kRunning, "explore").map.grid);
    common::RgbdFrame frame;
    frame.stamps.measured = Time::fromSeconds(12.5);
    frame.color = {2, 1, {255, 0, 0, 0, 255, 0}};
    common::Pose3 T_map_camera;
    T_map_camera.position_m = {1.0, 2.0, 1.5};
    run.savePhoto("door", frame, T_map_camera);
    run.savePhoto("door", frame, T_map_camera);
    test::Layers layers = flight.layers(MissionState::kRunning, "explore");
    layers.targets.targets.push_back({.id = 4, .name = "red", .number = 2, .position_map_m = {1.25, -2.0, 0.4}});
    run.world(layers.world());
    run.show(ReportPictures{kPng, "", {}});
    run.finish({});
    EXPECT_FALSE(run.failure());
  }
  for (const char* name : {"map-hall.pgm", "map-hall.yaml", "photo-01-door.jpg", "photo-02-door.jpg"})
    EXPECT_GT(std::filesystem::file_size(folder.path() / "run" / name), 10u) << name;
  EXPECT_THAT(bytesOf(folder / "run/report.html"), HasSubstr("src=\"data:image/jpeg;base64,/9j/"));
  EXPECT_EQ(json::parse(bytesOf(folder / "run/mission.json"))["targets"][0]["label"], "red 2");
  std::ifstream file(folder.path() / "run" / "photo-01-door.json");
  const json place = json::parse(file);
  EXPECT_EQ(place.at("stamp_s"), 12.5);
  EXPECT_EQ(place.at("camera_map_m"), json({1.0, 2.0, 1.5}));
  RunFolder next(folder.path() / "run", kInfo, "");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "run" / "photo-01-door.jpg"));
}

TEST(RunFolder, KeepsWhatWasRecognizedAndANewRunRemovesIt) {
  const ScratchFolder folder;
  {
    RunFolder run(folder.path() / "run", kInfo, "");
    Flight flight;
    common::RecognizedObject window;
    window.id = 3;
    window.what = "window";
    window.T_map_object.position_m = {1.25, -2.0, 1.1};
    window.passage = common::Passage::kOpen;
    window.looks = 4;
    window.confirmed = true;
    common::RecognizedObject candidate;
    candidate.id = 4;
    candidate.what = "opening";
    test::Layers layers = flight.layers(MissionState::kRunning, "explore");
    layers.objects = std::make_shared<const common::ObjectsLayer>(common::ObjectsLayer{{window, candidate}});
    run.world(layers.world());
    run.saveObjectPicture(window, std::vector<std::uint8_t>{0xff, 0xd8, 0xff, 0xe0});
    common::TopologicalMap places;
    places.places.push_back({.name = "kitchen"});
    run.savePlaces(places);
    run.show(ReportPictures{kPng, "", {}});
    run.finish({});
    EXPECT_FALSE(run.failure());
  }
  const json objects = json::parse(bytesOf(folder / "run/objects.json"))["objects"];
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0]["passage"], "open");
  EXPECT_EQ(objects[0]["position_map_m"], json({1.25, -2.0, 1.1}));
  EXPECT_EQ(objects[0]["covariance_m2"].size(), 9u);
  const json summary = json::parse(bytesOf(folder / "run/mission.json"))["objects"];
  ASSERT_EQ(summary.size(), 1u) << "without the candidate";
  EXPECT_EQ(summary[0]["label"], "window 3");
  const std::string report = bytesOf(folder / "run/report.html");
  EXPECT_THAT(report, HasSubstr("window 3 at (1.25, -2.00, 1.10)"));
  EXPECT_THAT(report, HasSubstr("1 seen from too few places"));
  EXPECT_TRUE(fs::exists(folder.path() / "run/object-03-window.jpg"));
  EXPECT_EQ(common::readTopologicalMap((folder.path() / "run/topological_map.yaml").string()).names().size(), 1u);
  RunFolder next(folder.path() / "run", kInfo, "");
  for (const char* name : {"objects.json", "object-03-window.jpg", "topological_map.yaml"})
    EXPECT_FALSE(fs::exists(folder.path() / "run" / name)) << name;
}

TEST(RunFolder, ContainsEveryFile) {
  const ScratchFolder folder;
  const fs::path path = folder / "deep/run";
  RunFolder run(path, kInfo, "speed: 1\n");
  run.event({Time::fromSeconds(0.5), Severity::kInfo, "mission", "ready", ""});
  Flight flight;
  flight.flyInto(run);
  run.show(ReportPictures{kPng, "", {"<svg></svg>"}});
  FlightEnd end{Outcome::kDone, "", 0.995, {{"goal_error_m", 0.05}}, 0.5};
  end.machine = {412.4, 30.0, 33.0};
  run.finish(end);
  ASSERT_EQ(run.failure(), std::nullopt);

  const json mission = json::parse(bytesOf(path / "mission.json"));
  EXPECT_EQ(mission["outcome"], "done");
  EXPECT_EQ(mission["seed"], 7);
  EXPECT_NEAR(mission["mission_time_s"].get<double>(), 9.0, 1e-9);
  EXPECT_NEAR(mission["machine"]["realtime_factor"].get<double>(), 20.0, 1e-9);
  EXPECT_EQ(mission["machine"]["memory_peak_MB"], 412.4);
  EXPECT_EQ(mission["machine"]["frame_last_ms"], 33.0);
  EXPECT_EQ(mission["coverage"], 0.995);
  EXPECT_EQ(mission["figures"]["goal_error_m"], 0.05);
  EXPECT_EQ(mission["explored_area_m2"], 12.5);
  ASSERT_EQ(mission["phases"].size(), 2u);
  EXPECT_EQ(mission["phases"][0]["name"], "take off");
  EXPECT_NEAR(mission["phases"][0]["duration_s"].get<double>(), 3.0, 1e-9);
  EXPECT_NEAR(mission["phases"][1]["end_s"].get<double>(), 10.0, 1e-9);
  ASSERT_EQ(mission["frontiers"].size(), 1u);
  EXPECT_EQ(mission["frontiers"][0]["reason"], "unreachable");

  const common::Trajectory trajectory = readTum(path / "trajectory.tum");
  EXPECT_EQ(trajectory.size(), 251u) << "25 Hz for 10 s";
  EXPECT_EQ(trajectory.back().pose.position_m, Eigen::Vector3d(10, 0.5, 1)) << "in map, not in odom";
  EXPECT_EQ(linesOfJson(path / "events.jsonl").size(), 1u);
  const StoredMap map = readMap(path / "map.yaml");
  EXPECT_TRUE(common::occupancy::isOccupied(map.grid.at(map.grid.cellAt(10.0, 1.0))));
  EXPECT_EQ(bytesOf(path / "map.png"), kPng);
  EXPECT_THAT(bytesOf(path / "report.html"), HasSubstr("explore_and_return"));
  EXPECT_EQ(std::distance(fs::directory_iterator(path), fs::directory_iterator{}), 8) << "and nothing else";
  EXPECT_EQ(run.summary().samples.size(), 51u) << "5 Hz for 10 s";
}

TEST(RunFolder, KeepsAVehiclesMemoryAsItWasReadAndAsItWasLearned) {
  const ScratchFolder folder;
  RunInfo info = kInfo;
  info.vehicle_memory_yaml = "version: 1\n";
  {
    RunFolder run(folder / "run", info, "");
    EXPECT_EQ(bytesOf(folder / "run/vehicle_memory_read.yaml"), "version: 1\n") << "from the start of the flight";
    FlightEnd end;
    end.vehicle_memory_yaml = "version: 1\nthrust: []\n";
    run.finish(end);
  }
  EXPECT_EQ(bytesOf(folder / "run/vehicle_memory_learned.yaml"), "version: 1\nthrust: []\n");
  RunFolder(folder / "run", kInfo, "").finish({});
  EXPECT_FALSE(fs::exists(folder / "run/vehicle_memory_read.yaml")) << "the older run's are removed";
  EXPECT_FALSE(fs::exists(folder / "run/vehicle_memory_learned.yaml"));
}

TEST(RunFolder, SaysWhichNatureWasFlownAndWhatWasDrawn) {
  const ScratchFolder folder;
  RunInfo info = kInfo;
  info.nature = "real";
  info.nature_yaml = "quadrotor: {mass_share: 1.07}\n";
  {
    RunFolder run(folder / "run", info, "");
    EXPECT_EQ(bytesOf(folder / "run/nature.yaml"), info.nature_yaml) << "from the start of the flight";
    run.finish({});
  }
  EXPECT_EQ(json::parse(bytesOf(folder / "run/mission.json"))["nature"], "real");
  EXPECT_THAT(bytesOf(folder / "run/report.html"), HasSubstr("nature real"));

  info.nature = "calm";
  info.nature_yaml.clear();
  RunFolder(folder / "run", info, "").finish({});
  EXPECT_FALSE(fs::exists(folder / "run/nature.yaml")) << "the older run's is removed, and calm draws nothing";
  EXPECT_EQ(json::parse(bytesOf(folder / "run/mission.json"))["nature"], "calm");
  RunFolder(folder / "run", kInfo, "").finish({});
  EXPECT_FALSE(json::parse(bytesOf(folder / "run/mission.json")).contains("nature")) << "a real vehicle has none";
}

TEST(RunFolder, ContainsTheTrajectoryInTheGivenMap) {
  const ScratchFolder folder;
  RunFolder run(folder / "run", kInfo, "");
  Flight flight;
  common::GivenMap office, lobby;
  office.name = "maps/office.yaml";
  lobby.name = "maps/lobby.yaml";
  const auto given = std::make_shared<const common::GivenMap>(office);
  const auto before = std::make_shared<const common::GivenMap>(lobby);
  for (int tick = 0; tick <= 100; ++tick) {
    flight.time_s = 0.1 * tick;
    auto layers = flight.layers(MissionState::kRunning, "explore");
    layers.vehicle.flight_state = common::FlightState::kFlying;
    common::Localization& localization = layers.map.localization.emplace();
    layers.map.given = tick < 10 ? before : given;  // The mission loads another map.
    if (tick < 10 || tick >= 40) localization.state = common::LocalizationState::kLocalized;
    localization.T_given_odom = {5.0, 0.0, 0.0};
    localization.T_given_body = {5.0 + flight.time_s, 0.0, 0.0};
    run.world(layers.world());
  }
  run.finish({});
  const json localization = json::parse(bytesOf(folder / "run/mission.json"))["localization"];
  EXPECT_EQ(localization["map"], "maps/office.yaml");
  EXPECT_EQ(localization["state"], "localized");
  EXPECT_EQ(localization["found_after_m"], 4.0);
  EXPECT_NEAR(localization["localized_s"].get<double>(), 6.1, 1e-6);
  EXPECT_EQ(localization["pose"]["x_m"], 15.0);
  const common::Trajectory trajectory = readTum(folder / "run/trajectory_given.tum");
  EXPECT_EQ(trajectory.size(), 61u);
  EXPECT_EQ(trajectory.front().pose.position_m, Eigen::Vector3d(9.0, 0.0, 1.0));
  EXPECT_THAT(bytesOf(folder / "run/report.html"), HasSubstr("after 4.0 m"));
}

TEST(RunFolder, TheSameFlightGivesTheSameBytes) {
  const ScratchFolder folder;
  for (const char* name : {"a", "b"}) {
    RunFolder run(folder / name, kInfo, "");
    Flight flight;
    flight.flyInto(run);
    run.finish({});
  }
  for (const char* file : {"trajectory.tum", "map.pgm", "map.yaml", "mission.json", "report.html"})
    EXPECT_EQ(bytesOf(folder / "a" / file), bytesOf(folder / "b" / file)) << file;
}

TEST(RunFolder, IsReadableAfterTheProcessWasKilled) {
  const ScratchFolder folder;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    RunFolder run(folder / "run", kInfo, "speed: 1\n");
    Flight flight;
    for (int tick = 0;; ++tick) {
      flight.time_s = 0.01 * tick;
      run.state(flight.state());
      run.event({Time::fromSeconds(flight.time_s), Severity::kInfo, "mission", "tick", ""});
      run.world(flight.world(MissionState::kRunning, "explore"));
      if (tick == 1000 && ::write(ready[1], "x", 1) != 1) ::_exit(1);
    }
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  ::usleep(3000);  // It continues to write, so that the signal comes at an arbitrary moment.
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));

  const json mission = json::parse(bytesOf(folder / "run/mission.json"));
  EXPECT_EQ(mission["outcome"], "flying");
  EXPECT_GE(mission["mission_time_s"].get<double>(), 9.0);
  EXPECT_GE(linesOfJson(folder / "run/events.jsonl").size(), 1000u);
  EXPECT_GE(readTum(folder / "run/trajectory.tum").size(), 250u);
  EXPECT_FALSE(knownExtent(readMap(folder / "run/map.yaml").grid).empty());
  EXPECT_THAT(bytesOf(folder / "run/report.html"), HasSubstr("</html>"));
  EXPECT_THAT(bytesOf(folder / "run/report.html"), HasSubstr("not finished"));

  // The next run may have the folder.
  { const RunFolder next(folder / "run", kInfo, ""); }
  EXPECT_EQ(bytesOf(folder / "run/events.jsonl"), "");
  EXPECT_FALSE(fs::exists(folder / "run/map.pgm")) << "no map of another flight";
}

TEST(RunFolder, ReportsAFullDiskAndLeavesNoPartialFile) {
  const ScratchFolder folder;
  EXPECT_TRUE(withFullDisk(15'000, [&] {
    RunFolder run(folder / "run", kInfo, "");
    Flight flight;
    flight.flyInto(run);
    const bool said = run.failure() && run.failure()->find("trajectory.tum: File too large") != std::string::npos;
    run.finish({Outcome::kStopped, "the disk is full", {}, {}, {}});
    return said;
  }));
  EXPECT_FALSE(readTum(folder / "run/trajectory.tum").empty());
  EXPECT_EQ(bytesOf(folder / "run/trajectory.tum").back(), '\n');
  EXPECT_EQ(json::parse(bytesOf(folder / "run/mission.json"))["outcome"], "stopped");
  for (const auto& entry : fs::directory_iterator(folder / "run")) EXPECT_NE(entry.path().extension(), ".part");
}

TEST(RunFolder, RoundsFiguresAndWritesNullForUnexplored) {
  const ScratchFolder folder;
  RunFolder run(folder / "run", kInfo, "");
  Flight flight;
  auto layers = flight.layers(MissionState::kRunning, "go to");
  layers.map.explored_area_m2 = 0.0;
  layers.vehicle.distance_flown_m = 30.563146064540703;
  run.world(layers.world());
  run.finish({});
  EXPECT_TRUE(json::parse(bytesOf(folder / "run/mission.json"))["explored_area_m2"].is_null());
  EXPECT_THAT(bytesOf(folder / "run/mission.json"), HasSubstr("\"distance_m\": 30.5631,"));
}

TEST(RunFolder, LeavesOutEstimatesThatAreNotFinite) {
  const ScratchFolder folder;
  RunFolder run(folder / "run", kInfo, "");
  Flight flight;
  common::VehicleState broken = flight.state();
  broken.T_odom_body.position_m.x() = std::nan("");
  run.state(broken);
  auto layers = flight.layers(MissionState::kRunning, "explore");
  layers.vehicle.state = broken;
  layers.vehicle.distance_flown_m = std::nan("");
  run.world(layers.world());
  run.finish({});
  EXPECT_EQ(run.failure(), std::nullopt);
  EXPECT_TRUE(readTum(folder / "run/trajectory.tum").empty());
  EXPECT_TRUE(json::parse(bytesOf(folder / "run/mission.json"))["distance_m"].is_null());
}

TEST(RunFolder, KeepsThe3DMapAndTheCamerasTrajectory) {
  const ScratchFolder folder;
  Flight flight;
  RunFolder run(folder / "run", kInfo, "");
  const auto seen = [&](double frame_s, bool tracked) {
    auto layers = flight.layers(MissionState::kRunning, "explore");
    auto map3d = std::make_shared<common::Map3dLayer>();
    auto frame = std::make_shared<common::RgbdFrame>();
    frame->stamps.measured = Time::fromSeconds(frame_s);
    map3d->frame = frame;
    map3d->tracked = tracked;
    map3d->T_map_camera.position_m.x() = frame_s;
    layers.map3d = map3d;
    run.world(layers.world());
    flight.time_s += 0.05;
  };
  seen(0.1, true);
  seen(0.1, true);  // The same frame in the next snapshot.
  seen(0.2, false);
  seen(0.3, true);
  run.wroteMap3d({{}, Time::fromSeconds(0.05)});
  run.wroteMap3d({});  // Of a cloud.
  EXPECT_FALSE(run.failure());
  run.wroteMap3d({tl::unexpected(FileError{common::Message("test.full", "cloud.ply: No space left on device")})});
  EXPECT_EQ(run.failure(), "cloud.ply: No space left on device");
  run.finish({});
  // The octree is still the first one, and the last snapshot was at 0.15 s.
  EXPECT_NEAR(json::parse(bytesOf(folder / "run/mission.json"))["octree_age_s"].get<double>(), 0.1, 1e-9);
  EXPECT_THAT(bytesOf(folder / "run/report.html"), HasSubstr("Age of the octree (map.bt, map.ot)"));
  const common::Trajectory trajectory = readTum(folder / "run/trajectory_camera.tum");
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[1].stamp, Time::fromSeconds(0.3));
  EXPECT_NEAR(trajectory[1].pose.position_m.x(), 0.3, 1e-9);
  // The view is along z of the file, and along x of the vehicle's frame `camera`.
  EXPECT_NEAR((trajectory[1].pose.rotation * Eigen::Vector3d::UnitZ()).x(), 1.0, 1e-6);
}

}  // namespace
}  // namespace swiftlet::interfaces
