// The whole autonomy in a simulated room: from sensor events and commands to setpoints, events and the world.
#include "autonomy/autonomy.hpp"

#include <cmath>
#include <cstdio>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/world/mission_layer.hpp"
#include "tests/autonomy/autonomy_story.hpp"

namespace swiftlet::autonomy {
namespace {

using testing::HasSubstr;

constexpr char kUpAndDown[] = R"(<TakeOff height_m="1.0"/><Land/>)";
/// Flies across the room until a command stops it.
constexpr char kAcross[] = R"(<TakeOff height_m="1.0"/><MoveToGoal goal="2.5;-2.0"/><MoveToGoal goal="-2.5;2.0"/>)"
                           R"(<MoveToGoal goal="2.5;-2.0"/><Land/>)";

bool isScan(const common::SensorEvent& event) {
  return std::holds_alternative<std::shared_ptr<const common::LaserScan>>(event);
}

TEST(Autonomy, FliesItsMissionAndReportsItsEventsInOrder) {
  AutonomyStory story(kUpAndDown);
  EXPECT_NE(story.autonomy().world(), nullptr) << "there is a world before the first event";
  ASSERT_TRUE(story.until([&] { return story.autonomy().finished(); }, 40.0));
  EXPECT_EQ(story.autonomy().missionStatus().state, MissionState::kDone);
  EXPECT_FALSE(story.autonomy().landedByOperator());

  const auto initialized = story.event("fusion", "initialized");
  const auto taking_off = story.event("flight", "taking off");
  const auto landing = story.event("flight", "landing");
  ASSERT_NE(initialized, story.events.end());
  ASSERT_NE(taking_off, story.events.end());
  ASSERT_NE(landing, story.events.end());
  EXPECT_LT(initialized, taking_off);
  EXPECT_LT(taking_off, landing);
  for (std::size_t i = 1; i < story.events.size(); ++i)
    EXPECT_LE(story.events[i - 1].stamp, story.events[i].stamp) << story.events[i].text;
  EXPECT_LT(story.world().vehicle->state.T_map_body().position_m.head<2>().norm(), 0.2) << "down where it rose";
}

TEST(Autonomy, SensorValuesThatAreNotNumbersChangeNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  AutonomyStory story(kUpAndDown);
  ASSERT_TRUE(story.isFlying());
  ASSERT_TRUE(story.fly(0.2));
  const double battery_v = story.world().energy->battery_voltage_v;
  int spoiled = 0, count = 0;
  story.hand = [&](common::SensorEvent& event) {
    if (auto* battery = std::get_if<common::BatterySample>(&event)) {
      battery->voltage_v = battery->remaining = nan;
      ++spoiled;
    } else if (auto* imu = std::get_if<common::ImuSample>(&event); imu && ++count % 20 == 0) {
      imu->specific_force_body_m_s2.x() = nan;
      ++spoiled;
    } else if (isScan(event)) {
      auto scan = *std::get<std::shared_ptr<const common::LaserScan>>(event);
      for (std::size_t i = 0; i < scan.ranges_m.size(); i += 10) scan.ranges_m[i] = static_cast<float>(nan);
      event = std::make_shared<const common::LaserScan>(std::move(scan));
      ++spoiled;
    }
    return true;
  };
  EXPECT_TRUE(story.fly(2.0));
  EXPECT_GT(spoiled, 50);
  EXPECT_TRUE(story.world().vehicle->state.T_map_body().position_m.allFinite());
  EXPECT_NEAR(story.world().energy->battery_voltage_v, battery_v, 0.5) << "the last good value is kept";
  EXPECT_TRUE(story.until([&] { return story.autonomy().finished(); }, 40.0));
  EXPECT_EQ(story.autonomy().missionStatus().state, MissionState::kDone);
}

TEST(Autonomy, TheOperatorHoldsAndResumes) {
  AutonomyStory story(kAcross);
  ASSERT_TRUE(story.isFlying());
  ASSERT_TRUE(story.until([&] { return story.world().vehicle->state.velocity_odom_m_s.norm() > 0.3; }, 20.0));
  EXPECT_TRUE(story.order(common::HoldCommand{}).accepted);
  ASSERT_TRUE(story.fly(3.0));
  EXPECT_EQ(story.autonomy().missionStatus().state, MissionState::kHeld);
  EXPECT_LT(story.world().vehicle->state.velocity_odom_m_s.norm(), 0.15);
  const Eigen::Vector3d held_at = story.world().vehicle->state.T_map_body().position_m;
  ASSERT_TRUE(story.fly(2.0));
  EXPECT_LT((story.world().vehicle->state.T_map_body().position_m - held_at).norm(), 0.15);

  EXPECT_TRUE(story.order(common::ResumeCommand{}).accepted);
  EXPECT_TRUE(story.until([&] { return story.world().vehicle->state.velocity_odom_m_s.norm() > 0.3; }, 10.0));
  EXPECT_EQ(story.autonomy().missionStatus().state, MissionState::kRunning);
}

TEST(Autonomy, TheOperatorLandsAndLaterCommandsAreRefused) {
  AutonomyStory story(kAcross);
  ASSERT_TRUE(story.isFlying());
  const common::CommandResult goal = story.order(common::GoalCommand{{1.0, 0.0}});
  EXPECT_FALSE(goal.accepted) << "the mission has no leaf for it";
  EXPECT_FALSE(goal.reason.empty());

  EXPECT_TRUE(story.order(common::LandCommand{}).accepted);
  ASSERT_TRUE(story.until([&] { return story.autonomy().finished(); }, 30.0));
  EXPECT_TRUE(story.autonomy().landedByOperator());
  EXPECT_EQ(story.autonomy().missionStatus().state, MissionState::kStopped);

  const common::CommandResult late = story.order(common::GoalCommand{{1.0, 0.0}});
  EXPECT_FALSE(late.accepted);
  EXPECT_THAT(late.reason, HasSubstr("the mission has ended"));
  EXPECT_FALSE(story.order(common::HomeCommand{}).accepted);
}

TEST(Autonomy, AHoldOnTheGroundHoldsThereEvenIfTheMissionHasNoHold) {
  AutonomyStory story(behaviors::Mission::fromText(
      R"(<root BTCPP_format="4" main_tree_to_execute="M"><BehaviorTree ID="M"><Sequence><TakeOff height_m="1.0"/>)"
      R"(<Land/></Sequence></BehaviorTree></root>)",
      "no_hold.xml"));
  EXPECT_TRUE(story.order(common::HoldCommand{}).accepted);
  ASSERT_TRUE(story.fly(5.0));
  EXPECT_EQ(story.world().vehicle->flight_state, FlightState::kPoweredOff);
  EXPECT_TRUE(story.order(common::ResumeCommand{}).accepted);
  EXPECT_TRUE(story.isFlying());
}

TEST(Autonomy, HoldDuringALandingIsRefusedWithItsReason) {
  AutonomyStory story(kAcross);
  ASSERT_TRUE(story.isFlying());
  EXPECT_TRUE(story.order(common::LandCommand{}).accepted);
  const common::CommandResult hold = story.order(common::HoldCommand{});
  EXPECT_FALSE(hold.accepted);
  EXPECT_THAT(hold.reason, HasSubstr("the vehicle is landing"));
  EXPECT_NE(story.event("operator", "land accepted"), story.events.end());
  const auto refused = story.event("operator", "hold refused");
  ASSERT_NE(refused, story.events.end());
  EXPECT_EQ(refused->reason, hold.reason);
}

TEST(Autonomy, HomeWorksInAMissionThatFliesItsOwnGoalsAndResumeContinuesIt) {
  AutonomyStory story(kAcross);
  ASSERT_TRUE(story.isFlying());
  const auto fromHome_m = [&] { return story.world().vehicle->state.T_map_body().position_m.head<2>().norm(); };
  ASSERT_TRUE(story.until([&] { return fromHome_m() > 1.0; }, 20.0));
  EXPECT_TRUE(story.order(common::HomeCommand{}).accepted);
  ASSERT_TRUE(story.until([&] { return story.event("supervisor", "home reached") != story.events.end(); }, 40.0));
  EXPECT_LT(fromHome_m(), 0.1);
  ASSERT_TRUE(story.fly(2.0));
  EXPECT_EQ(story.autonomy().missionStatus().state, MissionState::kHeld);
  EXPECT_LT(fromHome_m(), 0.15) << "it holds at home";

  EXPECT_TRUE(story.order(common::ResumeCommand{}).accepted);
  ASSERT_TRUE(story.until([&] { return story.autonomy().finished(); }, 60.0));
  EXPECT_EQ(story.autonomy().missionStatus().state, MissionState::kDone);
}

/// A mission that fails at a goal 2.5 m from home.
AutonomyStory failedMission(const char* take_off_ports) {
  return AutonomyStory(std::string("<TakeOff ") + take_off_ports + R"(/><MoveToGoal goal="2.5;0"/><AlwaysFailure/>)");
}

TEST(Autonomy, AMissionThatFailsInFlightFliesHomeBeforeItLands) {
  AutonomyStory story = failedMission("");
  ASSERT_TRUE(story.until([&] { return story.autonomy().finished(); }, 90.0));
  EXPECT_EQ(story.autonomy().missionStatus().state, MissionState::kFailed);
  EXPECT_NE(story.event("mission", "the mission has failed: the vehicle flies home"), story.events.end());
  EXPECT_LT(story.world().vehicle->state.T_map_body().position_m.head<2>().norm(), 0.2);
}

TEST(Autonomy, TheAuthorOfAMissionMayLandItWhereItFails) {
  AutonomyStory story = failedMission(R"(home_on_failure="false")");
  ASSERT_TRUE(story.until([&] { return story.autonomy().finished(); }, 90.0));
  EXPECT_NE(story.event("mission", "the mission has failed: the vehicle lands"), story.events.end());
  EXPECT_GT(story.world().vehicle->state.T_map_body().position_m.x(), 1.5) << "and not at home";
}

TEST(Autonomy, AGoalGivenWhileHeldIsShownAndNamedByResume) {
  AutonomyStory story(R"(<TakeOff/><OperatorCommand/>)");
  ASSERT_TRUE(story.isFlying());
  ASSERT_TRUE(story.fly(2.0));
  EXPECT_TRUE(story.order(common::HoldCommand{}).accepted);
  const common::CommandResult goal = story.order(common::GoalCommand{{1.5, 0.0}});
  EXPECT_TRUE(goal.accepted) << goal.reason;
  EXPECT_EQ(goal.reason, "flown after the hold: the operator holds");
  ASSERT_TRUE(story.fly(1.0));
  EXPECT_EQ(story.world().mission->waiting, "goal (1.50, 0.00)");
  EXPECT_EQ(story.world().mission->goal_map_m, Eigen::Vector2d(1.5, 0.0));
  EXPECT_EQ(story.order(common::ResumeCommand{}).reason, "next: goal (1.50, 0.00)");
  ASSERT_TRUE(
      story.until([&] { return story.event("mission", "goal (1.50, 0.00) reached") != story.events.end(); }, 20));
  EXPECT_EQ(story.world().mission->waiting, "");
}

TEST(Autonomy, HomeAfterAStopIsFlownWhateverMissionWasStopped) {
  for (const char* leaves :
       {R"(<TakeOff/><MoveToGoal goal="2.5;0"/><MoveToGoal goal="-2;0"/>)", R"(<TakeOff/><OperatorCommand/>)"}) {
    AutonomyStory story(leaves);
    ASSERT_TRUE(story.isFlying());
    const auto fromHome_m = [&] { return story.world().vehicle->state.T_map_body().position_m.head<2>().norm(); };
    (void)story.order(common::GoalCommand{{1.5, 0.0}});  // Refused by the mission without an OperatorCommand.
    ASSERT_TRUE(story.until([&] { return fromHome_m() > 1.0; }, 20.0));
    EXPECT_TRUE(story.order(common::StopMissionCommand{}).accepted);
    ASSERT_TRUE(story.fly(3.0));
    EXPECT_EQ(story.autonomy().missionStatus().phase, "wait for a mission");

    EXPECT_TRUE(story.order(common::HoldCommand{}).accepted);
    EXPECT_EQ(story.order(common::ResumeCommand{}).reason, "") << "nothing is next";
    const common::CommandResult home = story.order(common::HomeCommand{});
    EXPECT_TRUE(home.accepted);
    EXPECT_EQ(home.reason, "the vehicle holds there until a mission is started");
    ASSERT_TRUE(story.fly(1.0));
    EXPECT_NE(story.autonomy().missionStatus().phase, "wait for a mission");
    EXPECT_EQ(story.autonomy().missionStatus().reason, "the operator sent it home");
    ASSERT_TRUE(story.until([&] { return story.event("supervisor", "home reached") != story.events.end(); }, 40.0));
    EXPECT_LT(fromHome_m(), 0.1);
    ASSERT_TRUE(story.fly(1.0));
    EXPECT_EQ(story.autonomy().missionStatus().phase, "wait for a mission");
    EXPECT_FALSE(story.order(common::ResumeCommand{}).accepted) << "nothing is on hold";
  }
}

TEST(Autonomy, AMissionStartedDuringAHoldSaysThatItIsFlownAfterIt) {
  AutonomyStory story(R"(<TakeOff/><OperatorCommand/>)");
  ASSERT_TRUE(story.isFlying());
  EXPECT_TRUE(story.order(common::HoldCommand{}).accepted);
  const common::CommandResult start = story.order(common::StartMissionCommand{
      "next.xml", R"(<root BTCPP_format="4"><BehaviorTree ID="Next"><Sequence><TakeOff/><Land/></Sequence>)"
                  "</BehaviorTree></root>"});
  EXPECT_TRUE(start.accepted) << start.reason;
  EXPECT_EQ(start.reason, "when the vehicle has stopped, flown after the hold: the operator holds");
}

TEST(Autonomy, TheFirstScanThatComesTooLateIsAnEventAndAllAreCounted) {
  AutonomyStory story(R"(<TakeOff height_m="1.0"/>)");
  ASSERT_TRUE(story.isFlying());
  int late = 0;
  story.hand = [&](common::SensorEvent& event) {
    auto* scan = std::get_if<std::shared_ptr<const common::LaserScan>>(&event);
    if (scan == nullptr || late == 3) return true;
    auto older = std::make_shared<common::LaserScan>(**scan);
    older->stamps.measured = older->stamps.measured - common::Duration::fromMilliseconds(100);
    *scan = std::move(older);
    ++late;
    return true;
  };
  ASSERT_TRUE(story.until([&] { return late == 3; }, 1.0));
  ASSERT_TRUE(story.until([&] { return story.event("laser", "late scan rejected") != story.events.end(); }, 0.5));
  EXPECT_EQ(story.autonomy().counts().late_scans, 3u);
  EXPECT_EQ(std::count_if(story.events.begin(), story.events.end(),
                          [](const auto& e) { return e.text.starts_with("late scan rejected"); }),
            1);
  const std::string& reason = story.event("laser", "late scan rejected")->reason;
  EXPECT_NE(reason.find(" ms after it was measured"), std::string::npos) << reason;
}

TEST(Autonomy, WithoutScansItHoldsAndThenLands) {
  AutonomyStory story(kAcross);
  ASSERT_TRUE(story.isFlying());
  ASSERT_TRUE(story.fly(1.0));
  const common::Time dropped = story.now();
  story.hand = [](common::SensorEvent& event) { return !isScan(event); };
  ASSERT_TRUE(story.until([&] { return story.autonomy().finished(); }, 30.0));
  const auto hold = story.event("supervisor", "hold"), land = story.event("supervisor", "land");
  ASSERT_NE(hold, story.events.end());
  ASSERT_NE(land, story.events.end());
  EXPECT_NEAR((hold->stamp - dropped).seconds(), kUnseenHold_s, 0.1);
  EXPECT_NEAR((land->stamp - dropped).seconds(), kUnseenLand_s, 0.1);
  EXPECT_THAT(land->reason, HasSubstr("no scan"));
  EXPECT_EQ(story.autonomy().missionStatus().state, MissionState::kFailed);
  EXPECT_THAT(story.autonomy().missionStatus().reason, HasSubstr("no scan"));
  EXPECT_FALSE(story.autonomy().landedByOperator());
}

TEST(Autonomy, HoldEndsWhenScansReturn) {
  AutonomyStory story(kAcross);
  ASSERT_TRUE(story.isFlying());
  ASSERT_TRUE(story.fly(1.0));
  story.hand = [](common::SensorEvent& event) { return !isScan(event); };
  ASSERT_TRUE(story.fly(0.6));
  story.hand = [](common::SensorEvent&) { return true; };
  ASSERT_TRUE(story.fly(2.0));
  EXPECT_NE(story.event("supervisor", "scans are back"), story.events.end());
  EXPECT_EQ(story.event("supervisor", "land"), story.events.end());
  EXPECT_EQ(story.autonomy().missionStatus().state, MissionState::kRunning);
}

/// The descent begins within half a second, is named, is steered by the laser, and ends softly on the ground.
void landsWithoutInertialSamples(const HandledVehicle::Hand& hand, const std::string& fault) {
  AutonomyStory story(kAcross);
  ASSERT_TRUE(story.isFlying());
  ASSERT_TRUE(story.until([&] { return story.world().vehicle->state.velocity_odom_m_s.norm() > 0.3; }, 20.0));
  const common::Time since = story.now();
  story.hand = hand;
  ASSERT_TRUE(story.until([&] { return story.world().vehicle->flight_state == FlightState::kEmergencyLanding; }, 0.5));
  const auto noticed = story.event("flight", "inertial samples cannot be used");
  ASSERT_NE(noticed, story.events.end());
  EXPECT_LE((noticed->stamp - since).seconds(), 0.15);
  EXPECT_EQ(noticed->reason, fault);
  ASSERT_TRUE(story.fly(1.0));
  const common::VehicleState state = story.autonomy().state();
  EXPECT_TRUE(state.horizontal_valid) << "laser and setpoints no longer carry the position";
  EXPECT_LT(state.horizontalAge_s(story.now()), 0.2);
  EXPECT_LT(state.inertialAge_s(story.now()), 0.05);
  EXPECT_LT(state.velocity_odom_m_s.head<2>().norm(), 0.15) << "it has not braked";
  EXPECT_TRUE(story.until([&] { return story.autonomy().finished(); }, 20.0)) << "it crashes";
}

TEST(Autonomy, SilentInertialSensorsBeginAnEmergencyDescentWithinHalfASecond) {
  landsWithoutInertialSamples(
      [](common::SensorEvent& event) { return !std::holds_alternative<common::ImuSample>(event); },
      "no inertial samples");
}

TEST(Autonomy, RepeatedInertialSamplesBeginAnEmergencyDescentWithinHalfASecond) {
  landsWithoutInertialSamples(
      [last = std::optional<common::ImuSample>()](common::SensorEvent& event) mutable {
        if (auto* imu = std::get_if<common::ImuSample>(&event)) {
          if (!last) last = *imu;
          last->stamps = imu->stamps;
          *imu = *last;
        }
        return true;
      },
      "the inertial samples repeat");
}

TEST(Autonomy, InertialSamplesThatAreNotFiniteBeginAnEmergencyDescentWithinHalfASecond) {
  landsWithoutInertialSamples(
      [](common::SensorEvent& event) {
        if (auto* imu = std::get_if<common::ImuSample>(&event)) imu->rotation_ahrs_body.coeffs().setConstant(NAN);
        return true;
      },
      "the inertial samples are not finite");
}

TEST(Autonomy, AStoppedAhrsBeginsAnEmergencyDescentWithinHalfASecond) {
  landsWithoutInertialSamples(
      [last = std::optional<Eigen::Quaterniond>()](common::SensorEvent& event) mutable {
        if (auto* imu = std::get_if<common::ImuSample>(&event)) {
          if (!last) last = imu->rotation_ahrs_body;
          imu->rotation_ahrs_body = *last;
        }
        return true;
      },
      "the attitude of the AHRS is frozen");
}

using Scan = std::shared_ptr<const common::LaserScan>;

/// Replaces each scan by what `change` makes of it; null drops it.
HandledVehicle::Hand scans(std::function<Scan(const Scan&)> change) {
  return [change = std::move(change)](common::SensorEvent& event) {
    if (!isScan(event)) return true;
    const Scan changed = change(std::get<Scan>(event));
    if (changed == nullptr) return false;
    event = changed;
    return true;
  };
}

Scan stamped(const Scan& scan, const common::Stamps& stamps) {
  auto copy = std::make_shared<common::LaserScan>(*scan);
  copy->stamps = stamps;
  return copy;
}

HandledVehicle::Hand repeated() {
  return scans([last = Scan()](const Scan& scan) mutable {
    if (!last) last = scan;
    return stamped(last, scan->stamps);
  });
}

HandledVehicle::Hand late(double late_s) {
  return scans([late_s, waiting = std::deque<Scan>()](const Scan& scan) mutable {
    waiting.push_back(scan);
    const Scan oldest = waiting.front();
    if ((scan->stamps.measured - oldest->stamps.measured).seconds() < late_s) return Scan();
    waiting.pop_front();
    return stamped(oldest, {oldest->stamps.measured, scan->stamps.arrived});
  });
}

HandledVehicle::Hand clockAhead(double jump_s, double drift_s_s) {
  return scans([=, begin = std::optional<common::Time>()](const Scan& scan) mutable {
    common::Stamps stamps = scan->stamps;
    if (!begin) begin = stamps.measured;
    const double ahead_s = jump_s + drift_s_s * (stamps.measured - *begin).seconds();
    stamps.measured += common::Duration::fromSeconds(ahead_s);
    return stamped(scan, stamps);
  });
}

TEST(Autonomy, AfterThreeSecondsOfAFaultOfTheLaserTheFlightGoesOn) {
  const std::vector<std::pair<std::string, HandledVehicle::Hand>> faults{
      {"the laser repeats its last scan", repeated()},
      {"the laser's scans are late", late(0.3)},
      {"the laser's scans are late", late(0.7)},
      {"the laser's scans are late", late(1.5)},
      {"", [](common::SensorEvent& event) { return !isScan(event); }},
      {"the laser's clock has jumped", clockAhead(0.3, 0.0)},
      {"the laser's clock has jumped", clockAhead(-0.3, 0.0)},
      {"the laser's clock drifts", clockAhead(0.0, 0.05)},
      {"the laser's clock drifts", clockAhead(0.0, -0.05)}};
  for (const auto& [name, fault] : faults) {
    SCOPED_TRACE(name);
    AutonomyStory story(R"(<TakeOff height_m="1.0"/><MoveToGoal goal="2.5;-2.0"/><MoveToGoal goal="0;0"/><Land/>)");
    ASSERT_TRUE(story.isFlying());
    ASSERT_TRUE(story.fly(2.0));
    story.hand = fault;
    ASSERT_TRUE(story.fly(3.0));
    story.hand = [](common::SensorEvent&) { return true; };
    EXPECT_TRUE(story.until([&] { return story.autonomy().finished(); }, 60.0)) << "it does not end";
    EXPECT_EQ(story.autonomy().missionStatus().state, MissionState::kDone) << story.autonomy().missionStatus().reason;
    EXPECT_TRUE(name.empty() || story.event("laser", name) != story.events.end());
    EXPECT_EQ(story.event("supervisor", "land"), story.events.end());
  }
}

TEST(Autonomy, ALaserThatRepeatsItsScanIsASilentOne) {
  AutonomyStory story(kAcross);
  ASSERT_TRUE(story.isFlying());
  ASSERT_TRUE(story.fly(1.0));
  const common::Time since = story.now();
  story.hand = repeated();
  ASSERT_TRUE(story.until([&] { return story.autonomy().finished(); }, 30.0));
  const auto said = story.event("laser", "the laser repeats its last scan"), land = story.event("supervisor", "land");
  ASSERT_NE(said, story.events.end());
  ASSERT_NE(land, story.events.end());
  EXPECT_LT((said->stamp - since).seconds(), 0.15);
  EXPECT_THAT(land->reason, HasSubstr("no scan"));
}

TEST(Autonomy, WithoutTheLaserItEscapesTheWallsBeforeItLands) {
  AutonomyStory story(R"(<TakeOff height_m="1.0"/><MoveToGoal goal="4.3;-3.3"/><MoveToGoal goal="-2.5;2.0"/><Land/>)");
  ASSERT_TRUE(story.isFlying());
  ASSERT_TRUE(story.until([&] { return story.world().vehicle->state.T_map_body().position_m.x() > 4.0; }, 30.0));
  story.hand = [](common::SensorEvent& event) { return !isScan(event); };
  const auto isLost = [&] { return story.event("flight", "horizontal estimate lost") != story.events.end(); };
  ASSERT_TRUE(story.until(isLost, 2.0));
  double asked_m = 0.0;
  const std::string reason = story.event("flight", "horizontal estimate lost")->reason;
  ASSERT_EQ(std::sscanf(reason.c_str(), "flying %lf m away from the walls", &asked_m), 1) << reason;
  const Eigen::Vector3d lost_m = story.autonomy().state().T_odom_body.position_m;
  ASSERT_TRUE(story.until([&] { return story.autonomy().finished(); }, 30.0));
  const double flown_m = (story.autonomy().state().T_odom_body.position_m - lost_m).head<2>().norm();
  EXPECT_NEAR(flown_m, asked_m, 0.5 * asked_m) << "the landing cut it short, or something else was flown";
}

TEST(Autonomy, AVehicleThatSinksDoesNotMoveTheSliceOfTheMap) {
  AutonomyStory story(kAcross);
  ASSERT_TRUE(story.isFlying());
  ASSERT_TRUE(story.fly(3.0));
  EXPECT_NEAR(story.autonomy().mapHeight_m(), 1.0, 0.01);
  story.thrust_share = 0.55;
  const auto height_m = [&] { return story.world().vehicle->state.T_odom_body.position_m.z(); };
  ASSERT_TRUE(story.until([&] { return height_m() < 0.75; }, 5.0));
  EXPECT_EQ(story.world().vehicle->flight_state, FlightState::kFlying);
  EXPECT_NEAR(story.autonomy().mapHeight_m(), 1.0, 0.01);
}

TEST(Autonomy, ATakeOffAboveTheVehiclesGreatestHeightFailsUnlessTheMissionAllowsIt) {
  AutonomyStory high(R"(<TakeOff height_m="2.2"/><Land/>)");
  ASSERT_TRUE(high.until([&] { return high.autonomy().missionStatus().state == MissionState::kFailed; }, 10.0));
  EXPECT_THAT(high.autonomy().missionStatus().reason, HasSubstr("above the greatest height, 2.00 m"));
  EXPECT_TRUE(high.autonomy().finished());
  AutonomyStory allowed(R"(<TakeOff height_m="2.2" max_height_m="2.3"/><Land/>)");
  EXPECT_TRUE(allowed.isFlying());
}

}  // namespace
}  // namespace swiftlet::autonomy
