// One vehicle in a room: its time, its sensors, its flight and the end of the flight.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "event_bytes.hpp"
#include "fixtures.hpp"

namespace swiftlet::simulation {
namespace {

using common::Duration;
using common::Time;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A short tour of the room with everything switched on.
std::vector<common::SensorEvent> tour(int seed, bool camera) {
  Scenario scenario;
  scenario.seed = seed;
  scenario.wind = {.mean_x_m_s = 0.3, .mean_y_m_s = -0.2, .gust_m_s = 0.2, .gust_time_s = 1.0};
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

TEST(SimulatedVehicle, OnlyTheSameSeedGivesTheSameBytes) {
  const std::string first = bytesOf(tour(7, true), true);
  EXPECT_GT(first.size(), 100'000U);
  EXPECT_EQ(first, bytesOf(tour(7, true), true));
  EXPECT_NE(first, bytesOf(tour(8, true), true));
}

TEST(SimulatedVehicle, ACameraConsumerChangesNoOtherByte) {
  const auto with = tour(7, true), without = tour(7, false);
  EXPECT_EQ(eventsOf<Frame>(with).size(), 40U);
  EXPECT_TRUE(eventsOf<Frame>(without).empty()) << "pictures without a consumer are not rendered";
  EXPECT_EQ(bytesOf(with, false), bytesOf(without, false));
}

TEST(SimulatedVehicle, TheStepOfEachCallChangesNothing) {
  std::vector<common::SensorEvent> fine, coarse;
  SimulatedVehicle a(boxRoom(), Scenario()), b(boxRoom(), Scenario());
  for (int i = 1; i <= 1000; ++i) ASSERT_TRUE(a.advanceTo(Time::fromNanoseconds(i * 777'777), fine));
  ASSERT_TRUE(b.advanceTo(Time::fromNanoseconds(777'777'000), coarse));
  EXPECT_EQ(bytesOf(fine, true), bytesOf(coarse, true));
  EXPECT_EQ(a.now(), b.now());
}

TEST(SimulatedVehicle, SendsEachSensorAtItsRateInOrderOfArrival) {
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
  const common::Pose3 T_map_body = vehicle.trueT_map_body();
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

TEST(SimulatedVehicle, FlyingFastIntoASheetOfPaperCrashesAtTheSheet) {
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

TEST(SimulatedVehicle, ThePilotCanFlyWithoutTheAutonomy) {
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

TEST(SimulatedVehicle, APushMovesItWithoutACrash) {
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

TEST(SimulatedVehicle, AHandCarriesAndTurnsItWhateverItsPilotDoes) {
  Scenario scenario;
  scenario.hands.push_back({.time_s = 4.0, .lasts_s = 2.0, .x_m = -1.0, .yaw_deg = 45.0});
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(0, 0, 1);
  ASSERT_TRUE(pilot.fly(4.0));
  const common::Pose3 before = vehicle.truth().T_world_body;
  ASSERT_TRUE(pilot.fly(1.99)) << vehicle.stopReason();
  const common::Pose3 moved = vehicle.truth().T_world_body;
  EXPECT_NEAR(moved.position_m.x() - before.position_m.x(), -1.0, 0.05);
  EXPECT_NEAR(common::yawOf(moved.rotation) - common::yawOf(before.rotation), 0.785, 0.05);
  EXPECT_LT(vehicle.truth().velocity_world_m_s.head<2>().norm(), 0.15) << "it lets go at rest";
  ASSERT_TRUE(pilot.fly(4.0)) << vehicle.stopReason();
  EXPECT_NEAR(vehicle.truth().T_world_body.position_m.x(), before.position_m.x(), 0.1) << "and the pilot flies back";
}

}  // namespace
}  // namespace swiftlet::simulation
