// The recorder as a story, tick by tick.
#include "evaluation/flight_recorder.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "evaluation/statistics.hpp"
#include "tests/support/layers.hpp"

namespace swiftlet::evaluation {
namespace {

using common::MissionState;
using common::Pose3;
using common::Time;
using test::Layers;

/// The take-off place: at (3, 4) on a floor of 0.2 m, heading along the world's y.
const Pose3 kTakeOff{common::quaternionFrom({0, 0, M_PI_2}), {3, 4, 0.2}};

/// The truth if the vehicle is really at this place of the `map` frame.
simulation::Truth truthAt(double time_s, const Eigen::Vector3d& position_map_m) {
  simulation::Truth truth;
  truth.stamp = Time::fromSeconds(time_s);
  truth.T_world_body = kTakeOff * Pose3{Eigen::Quaterniond::Identity(), position_map_m};
  truth.airborne = true;
  return truth;
}

common::VehicleState estimateAt(double time_s, const Eigen::Vector3d& position_map_m) {
  common::VehicleState state;
  state.stamp = Time::fromSeconds(time_s);
  state.T_odom_body.position_m = position_map_m;
  return state;
}

Layers layersOf(double time_s, MissionState mission) {
  Layers layers;
  layers.stamp = Time::fromSeconds(time_s);
  layers.mission.status.state = mission;
  return layers;
}

common::World worldOf(double time_s, MissionState mission, const std::vector<std::pair<int, std::string>>& nodes = {}) {
  Layers layers = layersOf(time_s, mission);
  for (const auto& [id, status] : nodes) layers.mission.status.tree.push_back({id, id - 1, "node", status});
  return layers.world();
}

TEST(FlightRecorder, MeasuresErrorsInTheTrueMapFrame) {
  FlightRecorder recorder(kTakeOff);
  recorder.tick(truthAt(0.0, {0, 0, 1}), estimateAt(0.0, {0.03, 0.04, 1}));
  recorder.tick(truthAt(0.1, {1, 0, 1}), estimateAt(0.1, {1.03, 0.04, 1.12}));
  const FlightRecord record = recorder.finish();
  ASSERT_EQ(record.estimate.horizontal_errors_m.size(), 2u);
  EXPECT_NEAR(record.estimate.horizontal_errors_m[1], 0.05, 1e-12);
  EXPECT_NEAR(record.estimate.spatial_errors_m[1], 0.13, 1e-12);
  EXPECT_NEAR(record.estimate.yaw_errors_rad[1], 0.0, 1e-12);
  EXPECT_NEAR(record.true_distance_m, 1.0, 1e-12);
  EXPECT_NEAR(record.cruise_height_world_m, 1.2, 1e-12);
  ASSERT_EQ(record.estimate.truth_map.size(), 2u);
  EXPECT_NEAR((record.estimate.truth_map[1].pose.position_m - Eigen::Vector3d(1, 0, 1)).norm(), 0, 1e-12);
}

/// The covariance has the axes of odom: it is known to 1 cm along x of odom, which is y of the map here, and to 10 cm
/// across.
TEST(FlightRecorder, ComparesTheErrorWithTheCovarianceOfTheEstimate) {
  FlightRecorder recorder(kTakeOff);
  common::VehicleState state = estimateAt(0.0, {2, 0, 1});
  state.T_map_odom = {0.0, 0.0, M_PI_2};
  state.position_covariance_m2 = Eigen::Vector3d(1e-4, 1e-2, 1.0).asDiagonal();
  recorder.tick(truthAt(0.0, {0.0, 2.03, 1}), state);
  state.stamp = Time::fromSeconds(0.1);
  recorder.tick(truthAt(0.1, {0.3, 2.0, 1}), state);
  state.position_covariance_m2.setZero();
  state.stamp = Time::fromSeconds(0.2);
  recorder.tick(truthAt(0.2, {0.3, 2.0, 1}), state);
  const auto distances = recorder.finish().estimate.mahalanobis_distances;
  ASSERT_EQ(distances.size(), 2u) << "without a covariance there is no distance";
  EXPECT_NEAR(distances[0], 3.0, 1e-9);
  EXPECT_NEAR(distances[1], 3.0, 1e-9);
}

TEST(FlightRecorder, IncludesTheCorrectionOfTheMapFrame) {
  FlightRecorder recorder(kTakeOff);
  common::VehicleState state = estimateAt(0.0, {2, 0, 1});
  state.T_map_odom = {0.0, 0.1, M_PI_2};  // odom has drifted; map puts it right.
  recorder.tick(truthAt(0.0, {0, 2.1, 1}), state);
  EXPECT_NEAR(recorder.finish().estimate.horizontal_errors_m.at(0), 0.0, 1e-12);
  EXPECT_NEAR(recorder.finish().estimate.yaw_errors_rad.at(0), M_PI_2, 1e-12);
}

TEST(FlightRecorder, ComparesAnEstimateWithTheTruthAtItsStamp) {
  FlightRecorder recorder(kTakeOff);
  const auto along = [](double time_s) { return Eigen::Vector3d(time_s, 0, 1); };  // 1 m/s
  for (int i = 0; i <= 20; ++i) {
    const double now_s = 0.01 * i;
    recorder.tick(truthAt(now_s, along(now_s)), estimateAt(now_s - 0.035, along(now_s - 0.035)));
  }
  const auto late = recorder.finish();
  EXPECT_NEAR(statisticsOf(late.estimate.horizontal_errors_m).max, 0.0, 1e-9) << "late by 35 ms, and exact";
  EXPECT_EQ(late.estimate.horizontal_errors_m.size(), 17u)
      << "those of times before the first truth cannot be compared";

  FlightRecorder early(kTakeOff);
  for (int i = 0; i <= 20; ++i)
    early.tick(truthAt(0.01 * i, along(0.01 * i)), estimateAt(0.01 * i + 0.02, along(0.01 * i + 0.02)));
  EXPECT_NEAR(statisticsOf(early.finish().estimate.horizontal_errors_m).max, 0.0, 1e-9);
  EXPECT_EQ(early.finish().estimate.horizontal_errors_m.size(), 19u)
      << "the last two wait for a truth that did not come";
}

TEST(FlightRecorder, CountsARepeatedEstimateOnce) {
  FlightRecorder recorder(kTakeOff);
  for (int i = 0; i < 5; ++i) recorder.tick(truthAt(0.01 * i, {0, 0, 1}), estimateAt(0.0, {0, 0, 1}));
  EXPECT_EQ(recorder.finish().estimate.horizontal_errors_m.size(), 1u);
}

TEST(FlightRecorder, MeasuresNothingOnTheGround) {
  FlightRecorder recorder(kTakeOff);
  simulation::Truth truth = truthAt(0.0, {0, 0, 0});
  truth.airborne = false;
  recorder.tick(truth, estimateAt(0.0, {5, 5, 0}));
  EXPECT_TRUE(recorder.finish().estimate.horizontal_errors_m.empty());
  EXPECT_EQ(recorder.finish().true_distance_m, 0.0);
}

/// At 1 m/s along x of `map`; the given map is shifted from `map` by (10, 20) m and turned by a quarter.
TEST(FlightRecorder, AVehicleOnTheFloorIsInNoPhase) {
  FlightRecorder recorder(kTakeOff);
  recorder.watch({{.name = "all"}});
  recorder.world(worldOf(0.0, MissionState::kRunning));
  for (int i = 0; i < 100; ++i) {
    simulation::Truth truth = truthAt(0.1 * i, {0, 0, 1});
    truth.airborne = i <= 10;
    recorder.tick(truth, estimateAt(0.1 * i, {0, 0, 1}));
  }
  EXPECT_NEAR(recorder.finish().phases.at(0).figure("time_s").value(), 1.0, 1e-9);
}

TEST(FlightRecorder, RecordsTheLocalizationInTheGivenMap) {
  const common::Pose2 T_map_given{10.0, 20.0, M_PI_2};
  FlightRecorder recorder(kTakeOff, common::planar(kTakeOff) * T_map_given);
  const auto snapshot = [&](double time_s, common::LocalizationState state, double off_m) {
    const Eigen::Vector3d at(time_s, 0, 1);
    recorder.tick(truthAt(time_s, at), estimateAt(time_s, at));
    Layers layers = layersOf(time_s, MissionState::kRunning);
    layers.vehicle.state = estimateAt(time_s, at);
    layers.vehicle.flight_state = common::FlightState::kFlying;
    layers.map.localization.emplace().state = state;
    layers.map.localization->T_given_odom = T_map_given.inverse() * common::Pose2{off_m, 0.0, 0.0};
    recorder.world(layers.world());
  };
  using State = common::LocalizationState;
  snapshot(0.0, State::kGlobal, 0.0);
  snapshot(1.0, State::kAmbiguous, 0.0);
  snapshot(2.0, State::kLocalized, 0.1);
  snapshot(3.0, State::kLocalized, 0.6);
  snapshot(4.0, State::kLost, 0.0);
  const LocalizationRecord record = recorder.finish().localization.value();
  ASSERT_TRUE(record.found);
  EXPECT_NEAR(record.found->path_length_m, 2.0, 1e-9);
  EXPECT_NEAR(record.found->error_m, 0.1, 1e-9);
  EXPECT_NEAR(record.found->error_rad, 0.0, 1e-9);
  EXPECT_NEAR(record.flown_s, 4.0, 1e-9);
  EXPECT_NEAR(record.localized_s, 2.0, 1e-9);
  EXPECT_NEAR(record.wrong_s, 1.0, 1e-9);
  EXPECT_EQ(record.times_lost, 1);
}

TEST(FlightRecorder, RecordsNoLocalizationWithoutAMap) {
  FlightRecorder recorder(kTakeOff);
  recorder.world(worldOf(0.0, MissionState::kRunning));
  EXPECT_FALSE(recorder.finish().localization);
}

TEST(FlightRecorder, MeasuresAGoalWhenItsSuccessIsReported) {
  FlightRecorder recorder(kTakeOff);
  const common::Intent to_goal{7, common::GoToIntent{{3.0, -1.5}, {}, {}, 0.05, 0.1}};
  const common::Intent to_home{8, common::GoToIntent{{0.0, 0.0}, {}, {}, 0.05, 0.1}};
  const auto step = [&](double time_s, const Eigen::Vector3d& truth_map_m, const common::Intent& intent,
                        const common::IntentStatus& status) {
    recorder.tick(truthAt(time_s, truth_map_m), estimateAt(time_s, truth_map_m));
    recorder.intent(Time::fromSeconds(time_s), intent, status);
  };
  using common::IntentState;
  step(1.0, {2.0, -1.5, 1}, to_goal, {7, IntentState::kRunning, "", true});
  step(1.1, {2.9, -1.5, 1}, to_goal, {6, IntentState::kSucceeded, "", true});  // Of an older intent.
  step(1.2, {3.0, -1.44, 1}, to_goal, {7, IntentState::kSucceeded, "", true});
  step(1.3, {3.5, -1.5, 1}, to_goal, {7, IntentState::kSucceeded, "", true});  // Still reported, but recorded already.
  step(2.0, {0.03, 0.04, 1}, to_home, {8, IntentState::kSucceeded, "", true});
  const FlightRecord record = recorder.finish();
  ASSERT_EQ(record.goals.size(), 2u);
  EXPECT_FALSE(record.goals[0].home);
  EXPECT_NEAR(record.goals[0].error_m, 0.06, 1e-12);
  EXPECT_TRUE(record.goals[1].home);
  EXPECT_NEAR(record.goals[1].error_m, 0.05, 1e-12);
}

TEST(FlightRecorder, ComparesTheEstimateAtAGoalWithTheTruthAtItsStamp) {
  FlightRecorder recorder(kTakeOff);
  common::VehicleState state = estimateAt(0.96, {2.0, 1.0, 1});  // Late by 40 ms, at 1 m/s.
  state.T_map_odom = {0.97, 0.0, 0.0};
  recorder.tick(truthAt(0.9, {2.9, 1.0, 1}), estimateAt(0.9, {2.9, 1.0, 1}));
  recorder.tick(truthAt(1.0, {3.0, 1.0, 1}), state);
  recorder.intent(Time::fromSeconds(1), {7, common::GoToIntent{{3, 1}, {}, {}, 0.05, 0.1}},
                  {7, common::IntentState::kSucceeded, "", true});
  ASSERT_EQ(recorder.finish().goals.size(), 1u);
  const ComparedEstimate estimate = recorder.finish().goals[0].estimate;
  EXPECT_NEAR(estimate.T_map_truth.x_m, 2.96, 1e-9);
  EXPECT_NEAR(estimate.T_map_body.x_m, 2.97, 1e-9);
  EXPECT_NEAR(estimate.T_odom_body.x_m, 2.0, 1e-9);
}

TEST(FlightRecorder, DoesNotRecordAFailedGoal) {
  FlightRecorder recorder(kTakeOff);
  recorder.tick(truthAt(1.0, {0, 0, 1}), estimateAt(1.0, {0, 0, 1}));
  recorder.intent(Time::fromSeconds(1), {7, common::GoToIntent{{3, 0}, {}, {}, 0.05, 0.1}},
                  {7, common::IntentState::kFailed, "unreachable", true});
  recorder.intent(Time::fromSeconds(1), {8, common::HoldIntent{}}, {8, common::IntentState::kSucceeded, "", true});
  EXPECT_TRUE(recorder.finish().goals.empty());
}

TEST(FlightRecorder, RecordsInterruptionsAndTheirEnds) {
  FlightRecorder recorder(kTakeOff);
  const auto tree = [&](double time_s, const std::string& sequence, const std::string& explore) {
    recorder.world(worldOf(time_s, MissionState::kRunning, {{0, "RUNNING"}, {1, sequence}, {2, explore}}));
  };
  tree(0, "RUNNING", "RUNNING");
  tree(1, "SUSPENDED", "SUSPENDED");  // One interruption, whatever is below it.
  tree(2, "SUSPENDED", "SUSPENDED");
  tree(3, "RUNNING", "RUNNING");
  tree(4, "SUSPENDED", "SUSPENDED");
  tree(5, "IDLE", "IDLE");  // Given up.
  tree(6, "SUSPENDED", "SUSPENDED");
  const FlightRecord record = recorder.finish();
  EXPECT_EQ(record.mission.interruptions, 3);
  EXPECT_EQ(record.mission.resumed, 1);
}

TEST(FlightRecorder, MissionTimeRunsFromItsFirstTickToItsEnd) {
  FlightRecorder recorder(kTakeOff);
  recorder.world(worldOf(0.0, MissionState::kReady));
  recorder.world(worldOf(2.0, MissionState::kRunning));
  recorder.world(worldOf(50.0, MissionState::kHeld));
  recorder.world(worldOf(82.5, MissionState::kDone));
  recorder.world(worldOf(99.0, MissionState::kDone));
  EXPECT_DOUBLE_EQ(recorder.finish().mission.time_s, 80.5);
  EXPECT_EQ(recorder.finish().mission.state, MissionState::kDone);
}

}  // namespace
}  // namespace swiftlet::evaluation
