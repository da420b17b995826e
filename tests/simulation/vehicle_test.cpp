#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>

#include "common/config.hpp"
#include "common/error.hpp"
#include "fixtures.hpp"

namespace swiftlet::simulation {
namespace {

using common::Duration;
using common::Time;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Every number of an event, in order, so that two flights can be compared byte by byte.
void append(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}
template <typename Value>
void append(std::string& bytes, const Value& value) {
  append(bytes, &value, sizeof value);
}
std::string bytesOf(const common::SensorEvent& event) {
  std::string bytes;
  append(bytes, stampsOf(event).measured.nanoseconds());
  append(bytes, stampsOf(event).arrived.nanoseconds());
  append(bytes, event.index());
  if (const auto* imu = std::get_if<common::ImuSample>(&event)) {
    append(bytes, imu->angular_velocity_body_rad_s.data(), 3 * sizeof(double));
    append(bytes, imu->specific_force_body_m_s2.data(), 3 * sizeof(double));
    append(bytes, imu->rotation_ahrs_body.coeffs().data(), 4 * sizeof(double));
  } else if (const auto* scan = std::get_if<Scan>(&event)) {
    append(bytes, (*scan)->ranges_m.data(), (*scan)->ranges_m.size() * sizeof(float));
  } else if (const auto* battery = std::get_if<common::BatterySample>(&event)) {
    append(bytes, battery->voltage_v);
    append(bytes, battery->remaining);
  } else if (const auto* frame = std::get_if<Frame>(&event)) {
    append(bytes, (*frame)->image.rgb.data(), (*frame)->image.rgb.size());
  }
  return bytes;
}
std::string bytesOf(const std::vector<common::SensorEvent>& events, bool with_camera) {
  std::string bytes;
  for (const auto& event : events)
    if (with_camera || !std::holds_alternative<Frame>(event)) bytes += bytesOf(event);
  return bytes;
}

/// A short tour of the room with everything switched on.
std::vector<common::SensorEvent> tour(int seed, bool camera) {
  Scenario scenario;
  scenario.seed = seed;
  scenario.wind = {0.3, -0.2, 0.2, 1.0};
  scenario.sensors.camera.width_px = 32;
  scenario.sensors.camera.height_px = 24;
  scenario.walkers.push_back({WalkerMode::kPath, {3, -3, 3, 3}, WalkerEnd::kReturn});
  scenario.pushes.push_back({2.0, 0.5, 0.0, 0.0});
  SimulatedVehicle vehicle(boxRoom(), scenario);
  vehicle.setCameraConsumer(camera);
  TruthPilot pilot(vehicle);
  pilot.yaw_rate_rad_s = 0.5;
  pilot.flyTo(0, 0, 1);
  EXPECT_TRUE(pilot.fly(2)) << vehicle.stopReason();
  pilot.flyTo(-2, 1, 1.2);
  EXPECT_TRUE(pilot.fly(2)) << vehicle.stopReason();
  return pilot.events;
}

TEST(SimulatedVehicle, TheSameSeedGivesTheSameBytesAndAnotherSeedOthers) {
  const std::string first = bytesOf(tour(7, true), true);
  EXPECT_GT(first.size(), 100'000U);
  EXPECT_EQ(first, bytesOf(tour(7, true), true));
  EXPECT_NE(first, bytesOf(tour(8, true), true));
}

TEST(SimulatedVehicle, ACameraConsumerChangesNoOtherByte) {
  const auto with = tour(7, true), without = tour(7, false);
  EXPECT_EQ(eventsOf<Frame>(with).size(), 40U);
  EXPECT_TRUE(eventsOf<Frame>(without).empty()) << "what nobody looks at is not rendered";
  EXPECT_EQ(bytesOf(with, false), bytesOf(without, false));
}

TEST(SimulatedVehicle, HowFarEachCallAdvancesChangesNothing) {
  std::vector<common::SensorEvent> fine, coarse;
  SimulatedVehicle a(boxRoom(), Scenario()), b(boxRoom(), Scenario());
  for (int i = 1; i <= 1000; ++i) ASSERT_TRUE(a.advanceTo(Time::fromNanoseconds(i * 777'777), fine));
  ASSERT_TRUE(b.advanceTo(Time::fromNanoseconds(777'777'000), coarse));
  EXPECT_EQ(bytesOf(fine, true), bytesOf(coarse, true));
  EXPECT_EQ(a.now(), b.now());
}

TEST(SimulatedVehicle, SendsEachSensorAtItsRateOrderedByArrival) {
  SimulatedVehicle vehicle(boxRoom(), Scenario());
  std::vector<common::SensorEvent> events;
  ASSERT_TRUE(vehicle.advanceTo(Time::fromSeconds(10.0), events));
  EXPECT_EQ(eventsOf<common::ImuSample>(events).size(), 1999U);  // The last one is still under way.
  EXPECT_EQ(eventsOf<Scan>(events).size(), 400U);
  EXPECT_EQ(eventsOf<common::BatterySample>(events).size(), 50U);
  EXPECT_TRUE(eventsOf<common::PilotSample>(events).empty()) << "there is no remote control";
  Time last;
  for (const auto& event : events) {
    EXPECT_LE(last, stampsOf(event).arrived);
    EXPECT_LE(stampsOf(event).measured, stampsOf(event).arrived);
    last = stampsOf(event).arrived;
  }
  const auto scans = eventsOf<Scan>(events);
  EXPECT_EQ((scans[1]->stamps.measured - scans[0]->stamps.measured).nanoseconds(), 25'000'000);
  EXPECT_GE(scans[0]->stamps.arrived - scans[0]->stamps.measured, Duration::fromSeconds(0.0188 + 0.004));
}

TEST(SimulatedVehicle, StandsUntilItsMotorsRun) {
  SimulatedVehicle vehicle(boxRoom(), Scenario());
  std::vector<common::SensorEvent> events;
  ASSERT_TRUE(vehicle.advanceTo(Time::fromSeconds(5.0), events));
  EXPECT_FALSE(vehicle.truth().airborne);
  const common::Pose3 T_map_body = vehicle.T_world_map().inverse() * vehicle.truth().T_world_body;
  EXPECT_NEAR(T_map_body.position_m.z(), 0.146, 1e-3);
  EXPECT_LT(T_map_body.position_m.head<2>().norm(), 1e-3);
}

TEST(SimulatedVehicle, TakesOffFliesAndLandsSoftly) {
  SimulatedVehicle vehicle(boxRoom(), Scenario());
  TruthPilot pilot(vehicle);
  pilot.flyTo(0, 0, 1);
  ASSERT_TRUE(pilot.fly(4));
  EXPECT_TRUE(vehicle.truth().airborne);
  pilot.flyTo(2, 1, 1);
  ASSERT_TRUE(pilot.fly(5));
  EXPECT_LT((vehicle.truth().T_world_body.position_m - Eigen::Vector3d(2, 1, 1)).norm(), 0.25);
  pilot.max_speed_m_s = 0.4;
  pilot.flyTo(2, 1, 0.0);
  ASSERT_TRUE(pilot.fly(4)) << vehicle.stopReason();
  pilot.cutMotors();
  ASSERT_TRUE(pilot.fly(1)) << vehicle.stopReason();
  EXPECT_FALSE(vehicle.truth().airborne);
  EXPECT_FALSE(vehicle.truth().crashed);
  EXPECT_EQ(vehicle.stopReason(), "");
}

TEST(SimulatedVehicle, FallingOntoTheFloorIsACrash) {
  SimulatedVehicle vehicle(boxRoom(), Scenario());
  TruthPilot pilot(vehicle);
  pilot.flyTo(0, 0, 1.5);
  ASSERT_TRUE(pilot.fly(4));
  pilot.cutMotors();
  EXPECT_FALSE(pilot.fly(2));
  EXPECT_THAT(vehicle.stopReason(), ::testing::AllOf(HasSubstr("touched `floor`"), HasSubstr("too fast")));
}

TEST(SimulatedVehicle, FlyingFastIntoASheetOfPaperIsACrashAtTheSheet) {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("paper", {2.0, -4.0, 0.0}, {2.0001, 4.0, 3.0}));
  Scenario scenario;
  scenario.start = {false, -4.0, 0.0, 0.0, 0.0};
  SimulatedVehicle vehicle(world, scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(-4, 0, 1);
  ASSERT_TRUE(pilot.fly(4));
  pilot.max_speed_m_s = 10.0;
  pilot.flyTo(50, 0, 1);
  EXPECT_FALSE(pilot.fly(10));
  const Truth& truth = vehicle.truth();
  EXPECT_EQ(truth.touched, "paper");
  EXPECT_THAT(vehicle.stopReason(), StartsWith("touched `paper` at (2.00, "));
  EXPECT_NEAR(truth.T_world_body.position_m.x(), 2.0 - 0.275, 0.06);
  EXPECT_GT(truth.velocity_world_m_s.x(), 2.0);
  EXPECT_EQ(truth.min_clearance_m, 0.0);
  EXPECT_FALSE(truth.by_walker);
  std::vector<common::SensorEvent> more;
  const Time stopped = vehicle.now();
  EXPECT_FALSE(vehicle.advanceTo(Time::fromSeconds(100), more)) << "it stays crashed";
  EXPECT_EQ(vehicle.now(), stopped);
}

TEST(SimulatedVehicle, LosingTheLinkEndsInADescent) {
  SimulatedVehicle vehicle(boxRoom(), Scenario());
  TruthPilot pilot(vehicle);
  pilot.flyTo(0, 0, 1.5);
  ASSERT_TRUE(pilot.fly(4));
  std::vector<common::SensorEvent> events;
  (void)vehicle.advanceTo(vehicle.now() + Duration::fromSeconds(1.2), events);
  EXPECT_LT(vehicle.truth().velocity_world_m_s.z(), -0.1);
}

TEST(SimulatedVehicle, ThePilotMayFlyAlone) {
  Scenario scenario;
  scenario.pilot = {{0.0}, {3.0, 0.0, 0.0, 0.0, 0.7, true}};
  SimulatedVehicle vehicle(boxRoom(), scenario);
  std::vector<common::SensorEvent> events;
  ASSERT_TRUE(vehicle.advanceTo(Time::fromSeconds(2.9), events));
  EXPECT_FALSE(vehicle.truth().airborne);
  ASSERT_TRUE(vehicle.advanceTo(Time::fromSeconds(3.8), events));
  EXPECT_TRUE(vehicle.truth().airborne);
  const auto sticks = eventsOf<common::PilotSample>(events);
  ASSERT_GT(sticks.size(), 60U);
  EXPECT_FALSE(sticks.front().takes_over);
  EXPECT_TRUE(sticks.back().takes_over);
}

TEST(SimulatedVehicle, AWalkerThatRunsIntoAHoveringVehicleIsBlamed) {
  Scenario scenario;
  scenario.walkers.push_back({WalkerMode::kPath, {3, 0, -3, 0}, WalkerEnd::kStay, 1.0, 0.25, 1.75, 4.0});
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(0, 0, 1);
  EXPECT_FALSE(pilot.fly(10));
  EXPECT_EQ(vehicle.truth().touched, "walker 1");
  EXPECT_TRUE(vehicle.truth().by_walker);
  EXPECT_TRUE(vehicle.truth().yielding);
  EXPECT_EQ(vehicle.truth().min_walker_clearance_m, 0.0);
  // It walked 3 m less both radii.
  EXPECT_NEAR(vehicle.truth().contact_time.seconds(), 4.0 + 3.0 - 0.525, 0.3);
}

TEST(SimulatedVehicle, FlyingIntoAStandingPersonIsTheVehiclesFault) {
  Scenario scenario;
  scenario.walkers.push_back({WalkerMode::kPath, {2, 0}, WalkerEnd::kStay});
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(0, 0, 1);
  ASSERT_TRUE(pilot.fly(3));
  pilot.flyTo(4, 0, 1);
  EXPECT_FALSE(pilot.fly(5));
  EXPECT_TRUE(vehicle.truth().by_walker);
  EXPECT_FALSE(vehicle.truth().yielding);
}

TEST(SimulatedVehicle, AWalkerCrossesAheadInSightAndIsGone) {
  Scenario scenario;
  scenario.start = {false, -4.0, 0.0, 0.0, 0.0};
  scenario.walkers.push_back({.mode = WalkerMode::kCrossPath, .path_world_m = {}, .start_s = 1.0, .distance_m = 3.0});
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(-4, 0, 1);
  ASSERT_TRUE(pilot.fly(4));
  EXPECT_TRUE(vehicle.walkers().empty()) << "nobody crosses the way of one that stands still";
  pilot.max_speed_m_s = 0.5;
  pilot.flyTo(0, 0, 1);
  double least_y = 9, greatest_y = -9;
  bool came = false;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(pilot.fly(0.1)) << vehicle.stopReason();
    if (vehicle.walkers().empty()) continue;
    const Eigen::Vector2d at = vehicle.walkers()[0].position_world_m;
    if (!came) {
      EXPECT_GT((at - vehicle.truth().T_world_body.position_m.head<2>()).norm(), 2.0);
    }
    came = true;
    least_y = std::min(least_y, at.y());
    greatest_y = std::max(greatest_y, at.y());
  }
  EXPECT_TRUE(came);
  EXPECT_LT(least_y, -1.0);
  EXPECT_GT(greatest_y, 1.0);
  EXPECT_TRUE(vehicle.walkers().empty()) << "it went on its way";
}

TEST(SimulatedVehicle, AFollowerKeepsBehindInTheVehiclesTrail) {
  Scenario scenario;
  scenario.start = {false, -4.0, -3.0, 0.0, 0.0};
  scenario.walkers.push_back({.mode = WalkerMode::kFollow, .path_world_m = {}, .distance_m = 1.0});
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(-4, -3, 1);
  ASSERT_TRUE(pilot.fly(3));
  pilot.flyTo(4, -3, 1);
  ASSERT_TRUE(pilot.fly(9));
  pilot.flyTo(4, 3, 1);
  ASSERT_TRUE(pilot.fly(12)) << vehicle.stopReason();
  ASSERT_EQ(vehicle.walkers().size(), 1U);
  const Eigen::Vector2d gap = vehicle.truth().T_world_body.position_m.head<2>() - vehicle.walkers()[0].position_world_m;
  EXPECT_NEAR(gap.norm(), 1.0 + 0.275 + 0.25, 0.1) << "it came after and stopped";
  EXPECT_GT(vehicle.truth().min_walker_clearance_m, 0.9);
}

TEST(SimulatedVehicle, APushMovesItAndItStaysAlive) {
  Scenario scenario;
  scenario.pushes.push_back({4.0, 1.6, 0, 0});
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(0, 0, 1);
  ASSERT_TRUE(pilot.fly(4.0));
  const double before = vehicle.truth().velocity_world_m_s.x();
  ASSERT_TRUE(pilot.fly(0.15));
  EXPECT_GT(vehicle.truth().velocity_world_m_s.x() - before, 0.5);
}

// Sensors that break.

std::vector<common::SensorEvent> withFault(const FaultConfig& fault) {
  Scenario scenario;
  scenario.faults.push_back(fault);
  SimulatedVehicle vehicle(boxRoom(), scenario);
  std::vector<common::SensorEvent> events;
  EXPECT_TRUE(vehicle.advanceTo(Time::fromSeconds(5.0), events));
  return events;
}

TEST(Faults, ASilentLaserSendsNothingAndTheOthersAreUntouched) {
  const auto broken = withFault({Sensor::kLaser, FaultKind::kSilent, 1.0, 2.0});
  const auto sound = withFault({Sensor::kLaser, FaultKind::kSilent, 9.0, 9.0});
  EXPECT_EQ(eventsOf<Scan>(sound).size() - eventsOf<Scan>(broken).size(), 40U);
  for (const Scan& scan : eventsOf<Scan>(broken))
    EXPECT_TRUE(scan->stamps.measured.seconds() < 1.0 || scan->stamps.measured.seconds() >= 2.0);
  const auto imu_a = eventsOf<common::ImuSample>(broken), imu_b = eventsOf<common::ImuSample>(sound);
  ASSERT_EQ(imu_a.size(), imu_b.size());
  for (std::size_t i = 0; i < imu_a.size(); ++i) EXPECT_EQ(bytesOf(imu_a[i]), bytesOf(imu_b[i]));
}

TEST(Faults, NanFillsTheScan) {
  for (const Scan& scan : eventsOf<Scan>(withFault({Sensor::kLaser, FaultKind::kNan, 1.0, 2.0}))) {
    const bool in_fault = scan->stamps.measured.seconds() >= 1.0 && scan->stamps.measured.seconds() < 2.0;
    EXPECT_EQ(std::isnan(scan->ranges_m[500]), in_fault);
  }
  int nan = 0;
  for (const auto& imu : eventsOf<common::ImuSample>(withFault({Sensor::kImu, FaultKind::kNan, 1.0, 2.0})))
    nan += std::isnan(imu.specific_force_body_m_s2.x()) ? 1 : 0;
  EXPECT_EQ(nan, 200);
}

TEST(Faults, ARepeatedScanHasOldRangesAndNewStamps) {
  const auto scans = eventsOf<Scan>(withFault({Sensor::kLaser, FaultKind::kRepeat, 1.0, 2.0}));
  const std::vector<float>* last_good = nullptr;
  for (const Scan& scan : scans) {
    const double t = scan->stamps.measured.seconds();
    if (t < 1.0) last_good = &scan->ranges_m;
    if (t >= 1.0 && t < 2.0) {
      EXPECT_EQ(scan->ranges_m, *last_good);
    }
    if (t >= 2.0) {
      EXPECT_NE(scan->ranges_m, *last_good);
    }
  }
  EXPECT_EQ(scans.size(), 200U);
}

TEST(Faults, ALateScanArrivesLate) {
  int late = 0;
  for (const Scan& scan : eventsOf<Scan>(withFault({Sensor::kLaser, FaultKind::kLate, 1.0, 2.0, 0.5})))
    late += (scan->stamps.arrived - scan->stamps.measured).seconds() > 0.5 ? 1 : 0;
  EXPECT_EQ(late, 40);
}

TEST(Faults, ALossyLinkLosesItsShare) {
  Scenario scenario;
  scenario.sensors.imu_link.loss_rate = 0.1;
  SimulatedVehicle vehicle(boxRoom(), scenario);
  std::vector<common::SensorEvent> events;
  ASSERT_TRUE(vehicle.advanceTo(Time::fromSeconds(10.0), events));
  EXPECT_NEAR(static_cast<double>(eventsOf<common::ImuSample>(events).size()), 1800, 50);
  EXPECT_EQ(eventsOf<Scan>(events).size(), 400U);
}

// What a seed varies.

TEST(Variation, IsTheSameForASeedAndKeepsWithinItsBounds) {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("crate", {2.0, -0.5, 0.0}, {3.0, 0.5, 1.5}));
  Scenario scenario;
  scenario.variation.start_position_m = 0.3;
  scenario.variation.start_yaw_deg = 10.0;
  scenario.variation.obstacles = {"crate"};
  scenario.variation.wind_m_s = 0.2;
  scenario.variation.battery_remaining = 0.1;
  std::vector<double> xs;
  for (int seed = 1; seed <= 20; ++seed) {
    scenario.seed = seed;
    const SimulatedVehicle a(world, scenario), b(world, scenario);
    EXPECT_EQ(a.T_world_map().position_m, b.T_world_map().position_m);
    EXPECT_EQ(a.world().shapes.back().vertices_world_m[0], b.world().shapes.back().vertices_world_m[0]);
    EXPECT_LE(a.T_world_map().position_m.head<2>().lpNorm<Eigen::Infinity>(), 0.3);
    EXPECT_LE(std::abs(common::yawOf(a.T_world_map().rotation)), 10.0 * M_PI / 180 + 1e-9);
    EXPECT_LE((a.world().shapes.back().vertices_world_m[0] - world.shapes.back().vertices_world_m[0]).norm(), 0.43F);
    EXPECT_GE(a.scenario().battery_remaining, 0.9);
    EXPECT_EQ(a.scenario().start.x_m, a.T_world_map().position_m.x());
    xs.push_back(a.T_world_map().position_m.x());
  }
  std::sort(xs.begin(), xs.end());
  EXPECT_LT(xs.front(), -0.1);
  EXPECT_GT(xs.back(), 0.1);
}

TEST(Variation, DrawsAgainUntilStartIsFreeAndGoalReachable) {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("crate", {0.35, -0.5, 0.0}, {1.35, 0.5, 1.5}));
  Scenario scenario;
  scenario.variation.start_position_m = 0.3;
  scenario.variation.obstacles = {"crate"};
  scenario.variation.reachable_map_m = {2.0, 0.0};
  int redraws = 0;
  for (int seed = 1; seed <= 10; ++seed) {
    scenario.seed = seed;
    const SimulatedVehicle vehicle(world, scenario);
    redraws += vehicle.redraws();
    const Eigen::Vector3d body = vehicle.truth().T_world_body.position_m;
    EXPECT_EQ(vehicle.rays().sweep({}, body, body, 0.01).shape, Hit::kNothing);
  }
  EXPECT_GT(redraws, 0);
  scenario.variation.reachable_map_m = {9.0, 0.0};
  try {
    const SimulatedVehicle vehicle(world, scenario);
    FAIL() << "a goal outside the room";
  } catch (const common::InputError& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(HasSubstr("(9.00, 0.00)"), HasSubstr("none of the 200 draws")));
  }
  scenario.variation.obstacles = {"crates"};
  try {
    const SimulatedVehicle vehicle(world, scenario);
    FAIL() << "an obstacle that is not there";
  } catch (const common::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean `crate`?"));
  }
}

TEST(Variation, AStartAnywhereIsOnTheFloorWithRoomAboveAndAWayToTheNominalOne) {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("stage", {-5.0, -4.0, 0.0}, {-3.0, 4.0, 0.3}));
  world.shapes.push_back(boxShape("awning", {3.0, -4.0, 0.45}, {5.0, 4.0, 0.5}));
  // A closet that nothing leads into.
  world.shapes.push_back(boxShape("closet_south", {-1.0, 2.0, 0.0}, {1.5, 2.1, 3.0}));
  world.shapes.push_back(boxShape("closet_west", {-1.1, 2.0, 0.0}, {-1.0, 4.0, 3.0}));
  world.shapes.push_back(boxShape("closet_east", {1.5, 2.0, 0.0}, {1.6, 4.0, 3.0}));
  Scenario scenario;
  scenario.variation.start_area_world_m = {5.0, 4.0, -5.0, -4.0};
  scenario.variation.start_yaw_deg = 180.0;
  scenario.variation.flight_height_m = 0.5;
  double least_x_m = 5.0, most_x_m = -5.0, most_yaw_rad = 0.0;
  for (int seed = 1; seed <= 40; ++seed) {
    scenario.seed = seed;
    const SimulatedVehicle vehicle(world, scenario);
    const Eigen::Vector3d at = vehicle.T_world_map().position_m;
    EXPECT_NEAR(at.z(), 0.0, 1e-6) << "on the stage, seed " << seed;
    EXPECT_LT(at.x(), 3.0) << "under the awning, seed " << seed;
    EXPECT_FALSE(at.x() > -1.0 && at.x() < 1.5 && at.y() > 2.0) << "in the closet, seed " << seed;
    least_x_m = std::min(least_x_m, at.x());
    most_x_m = std::max(most_x_m, at.x());
    most_yaw_rad = std::max(most_yaw_rad, std::abs(common::yawOf(vehicle.T_world_map().rotation)));
  }
  EXPECT_LT(least_x_m, -2.0);
  EXPECT_GT(most_x_m, 2.0);
  EXPECT_GT(most_yaw_rad, 2.5);
}

TEST(Scenario, PrintsAsYamlAndReadsBack) {
  Scenario scenario;
  scenario.seed = 5;
  scenario.world = "worlds/a.sdf";
  scenario.walkers.push_back({WalkerMode::kPath, {1, 2, 3, 4}, WalkerEnd::kReturn});
  scenario.faults.push_back({Sensor::kLaser, FaultKind::kNan, 1, 2, 0.5});
  scenario.pilot.push_back({1.0, 0.1, 0.2, 0.3, 0.4, true});
  scenario.pushes.push_back({1.0, 2.0, 3.0, 4.0});
  const std::string text = common::config::YamlPrinter(common::config::YamlPrinter::Comments::kNo).print(scenario);
  Scenario back;
  common::config::YamlReader::fromText(text, "scenario.yaml").read(back);
  EXPECT_EQ(common::config::YamlPrinter(common::config::YamlPrinter::Comments::kNo).print(back), text);
  EXPECT_EQ(back.walkers[0].at_end, WalkerEnd::kReturn);
  EXPECT_EQ(back.faults[0].kind, FaultKind::kNan);
}

TEST(Scenario, TheShippedSensorsAndVehicleLoad) {
  for (const char* name : {"utm_30lx", "urg_04lx"}) {
    const auto laser = common::config::readFile<common::LaserConfig>(SWIFTLET_SOURCE_DIR "/config/sensors/" +
                                                                     std::string(name) + ".yaml");
    EXPECT_EQ(laser.name, name);
    EXPECT_GE(laser.mirror_beams, 10);
  }
  EXPECT_EQ(common::config::readFile<common::VehicleConfig>(SWIFTLET_SOURCE_DIR "/config/vehicles/cobra.yaml").name,
            "cobra");
}

}  // namespace
}  // namespace swiftlet::simulation
