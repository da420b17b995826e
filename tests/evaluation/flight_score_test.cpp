// From a record to figures, and from figures to a verdict.
#include "evaluation/flight_scoring.hpp"

#include <gmock/gmock.h>

#include "common/config_check.hpp"
#include "common/error.hpp"
#include "small_world.hpp"

namespace swiftlet::evaluation {
namespace {

using common::MissionState;
using testing::AllOf;
using testing::AnyOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A flight in the small room that meets every criterion.
FlightRecord goodRecord() {
  FlightRecord record;
  record.T_world_start.position_m = record.T_world_map.position_m = {1.0, 1.0, 0.0};
  record.goals = {{common::Time::fromSeconds(60), false, {1.0, 0.5}, 0.06, {}},
                  {common::Time::fromSeconds(80), true, {0, 0}, 0.04, {}}};
  record.estimate.horizontal_errors_m = {0.03, 0.03};
  record.estimate.spatial_errors_m = {0.04, 0.04};
  record.estimate.yaw_errors_rad = {0.01, 0.01};
  record.cruise_height_world_m = 1.0;
  record.mission.state = MissionState::kDone;
  record.mission.time_s = 82.0;
  record.flight_time_s = 90.0;
  record.true_distance_m = 40.0;
  common::OccupancyGrid map = common::makeOccupancyGrid(0.05);
  smallMap().forEachCell([&](common::CellIndex c, common::occupancy::Cell value) {
    if (!common::occupancy::isUnknown(value)) map.set({c.x - 20, c.y - 20}, value);
  });
  record.map = std::make_shared<common::OccupancyGrid>(map);
  return record;
}

class FlightScoring : public testing::Test {
 protected:
  FlightScore score(const FlightRecord& record, const Criteria& criteria = {}) {
    TrueWorld world;
    world.rays = &rays_;
    return scoreOf(record, world, criteria, 7, 3.0);
  }
  simulation::RayCaster rays_{smallWorld(1.0F)};
};

/// Overconfident and inflated covariances miss their criteria.
TEST_F(FlightScoring, TheCovarianceOfThePositionIsJudged) {
  FlightRecord record = goodRecord();
  record.estimate.mahalanobis_distances = {1.0, 1.0, 1.0, 4.0};
  EXPECT_NEAR(*score(record).figure("position_outside_share"), 0.25, 1e-12);
  EXPECT_NEAR(*score(record).figure("position_mahalanobis_mean_square"), 19.0 / 4.0, 1e-12);
  record.estimate.mahalanobis_distances.clear();
  EXPECT_FALSE(score(record).figure("position_outside_share"));
}

TEST_F(FlightScoring, AGoodFlightPasses) {
  Criteria criteria;
  criteria["coverage_min"] = 0.99;
  criteria["goal_error_max_m"] = criteria["home_error_max_m"] = 0.16;
  criteria["mission_time_max_s"] = 90;
  criteria["estimate_rms_max_m"] = criteria["map_wall_error_max_m"] = 0.05;
  const FlightScore result = score(goodRecord(), criteria);
  EXPECT_THAT(result.failures, IsEmpty());
  EXPECT_EQ(result.seed, 7);
  EXPECT_EQ(result.outcome, "done");
  EXPECT_EQ(result.figure("coverage"), 1.0);
  EXPECT_EQ(result.figure("goal_error_m"), 0.06);
  EXPECT_EQ(result.figure("home_error_m"), 0.04);
  EXPECT_NEAR(*result.figure("estimate_rms_m"), 0.03, 1e-12);
  EXPECT_NEAR(*result.figure("map_wall_error_median_m"), 0.025, 1e-3);
  EXPECT_DOUBLE_EQ(result.figure("realtime_factor").value(), 30.0);
  EXPECT_GT(result.figure("reachable_area_m2"), 8.0);
}

TEST_F(FlightScoring, EveryMissedCriterionIsNamed) {
  FlightRecord record = goodRecord();
  record.mission.state = MissionState::kFailed;
  record.mission.reason = "goal unreachable";
  record.goals.clear();
  record.map = std::make_shared<common::OccupancyGrid>(common::makeOccupancyGrid(0.05));
  record.mission.interruptions = 2;
  record.mission.resumed = 1;
  Criteria criteria;
  criteria["coverage_min"] = 0.99;
  criteria["goal_error_max_m"] = 0.16;
  criteria["mission_time_max_s"] = 80;
  criteria["estimate_rms_max_m"] = criteria["estimate_spatial_rms_max_m"] = 0.02;
  EXPECT_THAT(
      score(record, criteria).failures,
      ElementsAre("mission: mission failed: goal unreachable", "coverage: 0.0000, at least 0.99 was asked for",
                  "goal error, m: not measured, at most 0.16 was asked for",
                  "mission time, s: 82.000, at most 80 was asked for",
                  "estimate RMS, m: 0.030, at most 0.02 was asked for",
                  "estimate RMS in space, m: 0.040, at most 0.02 was asked for", "interruptions: 1 of 2 went on"));
}

// However the flight ended: a program that fills the memory is no better for having crashed.
TEST_F(FlightScoring, WhatTheComputerNeededIsAskedOfEveryFlight) {
  TrueWorld world;
  world.rays = &rays_;
  Criteria criteria;
  criteria.verdicts = true;
  criteria["memory_max_MB"] = 1000;
  criteria["frame_growth_max"] = 1.5;
  FlightRecord record = goodRecord();
  record.mission.state = MissionState::kFailed;
  const auto failures = [&](const common::MachineUse& machine) {
    return scoreOf(record, world, criteria, 7, 3.0, machine).failures;
  };
  EXPECT_THAT(failures({999.0, 20.0, 29.0}), Not(Contains(AnyOf(HasSubstr("memory"), HasSubstr("frame")))));
  EXPECT_THAT(failures({1001.0, 20.0, 31.0}),
              AllOf(Contains("memory, MB: 1001.000, at most 1000 was asked for"),
                    Contains("camera frame at the end over one at the start: 1.550, at most 1.5 was asked for")));
  EXPECT_THAT(failures({}), AllOf(Contains("memory, MB: not measured, at most 1000 was asked for"),
                                  Contains(HasSubstr("at the start: not measured"))));
}

// Without the north wall the flood fill leaves the room.
TEST_F(FlightScoring, AnOpenWorldHasNoCoverageAndNamesTheReason) {
  simulation::WorldModel open = smallWorld(1.0F);
  std::erase_if(open.shapes, [](const simulation::Shape& shape) { return shape.model == "north"; });
  const simulation::RayCaster rays(open);
  TrueWorld world;
  world.rays = &rays;
  Criteria criteria;
  criteria["coverage_min"] = 0.99;
  const FlightScore result = scoreOf(goodRecord(), world, criteria, 7, 3.0);
  EXPECT_FALSE(result.figure("coverage"));
  EXPECT_EQ(result.coverage_problem, "the world is not closed: the hull gets from the start to more than 2000 m2");
  EXPECT_THAT(result.failures, ElementsAre("coverage: not measured: the world is not closed: the hull gets from the "
                                           "start to more than 2000 m2, at least 0.99 was asked for"));
  EXPECT_THAT(scoreOf(goodRecord(), world, {}, 7, 3.0).failures, IsEmpty()) << "without a criterion nothing is missed";
}

TEST_F(FlightScoring, TheWorstGoalCounts) {
  FlightRecord record = goodRecord();
  record.goals.push_back({common::Time::fromSeconds(70), false, {0, 1}, 0.2, {}});
  EXPECT_EQ(score(record).figure("goal_error_m"), 0.2);
}

TEST_F(FlightScoring, MarkersAreJudgedByTheirBounds) {
  FlightRecord record = goodRecord();
  record.goals[0].estimate.T_map_body = {0.008, 0.0, 0.0};
  record.goals.push_back(record.goals[0]);
  record.goals.back().estimate.T_map_body = {-0.012, 0.0, 0.0};
  Criteria criteria;
  criteria["marker_error_max_m"] = criteria["relocalization_error_max_m"] = 0.01;
  const FlightScore result = score(record, criteria);
  EXPECT_EQ(result.visits.size(), 3u);
  EXPECT_THAT(result.failures, ElementsAre("marker error, m: 0.012, at most 0.01 was asked for",
                                           "relocalization error, m: 0.020, at most 0.01 was asked for"));
  criteria["marker_error_max_m"] = criteria["relocalization_error_max_m"] = 0.021;
  EXPECT_THAT(score(record, criteria).failures, IsEmpty());
  record.goals.clear();
  EXPECT_EQ(score(record, criteria).failures.size(), 2u) << "what was not measured is missed";
}

TEST_F(FlightScoring, AVehicleThatComesHomeUndoneMustHaveFlownFarEnough) {
  FlightRecord record = goodRecord();
  record.mission.state = MissionState::kFailed;
  record.mission.reason = "landed: home again";
  record.last_truth.T_world_body.position_m = {1.3, 1.4, 0.15};
  Criteria criteria;
  criteria.mission_done = false;
  criteria["end_distance_max_m"] = 0.51;
  criteria["unfinished_distance_min_m"] = 40.0;
  EXPECT_THAT(score(record, criteria).failures, IsEmpty());
  EXPECT_NEAR(*score(record, criteria).figure("end_distance_m"), 0.5, 1e-9);

  criteria["end_distance_max_m"] = 0.49;
  criteria["unfinished_distance_min_m"] = 41.0;
  EXPECT_THAT(score(record, criteria).failures,
              ElementsAre(HasSubstr("distance from the take-off place at the end, m: 0.5"),
                          HasSubstr("distance flown without having done the mission, m: 40")));
  record.mission.state = MissionState::kDone;
  EXPECT_THAT(score(record, criteria).failures, ElementsAre(HasSubstr("at the end, m")));
}

TEST_F(FlightScoring, AnAvoidableCollisionFails) {
  FlightRecord record = goodRecord();
  record.contact.emplace().what = "touched `north_wall`";
  const FlightScore result = score(record);
  EXPECT_EQ(result.collisions, 1);
  EXPECT_EQ(result.avoidable_collisions, 1);
  EXPECT_FALSE(result.mission_done);
  EXPECT_THAT(result.failures,
              ElementsAre("mission: touched `north_wall`", "collision (crashed): touched `north_wall`"));
}

TEST_F(FlightScoring, AWalkerIsBlamedForHittingAVehicleThatCouldNotEvade) {
  FlightRecord record = goodRecord();
  record.contact.emplace().what = "touched `walker_0`";
  record.contact->truth.by_walker = record.contact->truth.yielding = true;
  record.contact->truth.walker_in_field_s = 0.3;
  record.contact->replay = {true, true};
  const FlightScore result = score(record);
  EXPECT_EQ(result.collisions, 1) << "it is reported all the same";
  EXPECT_EQ(result.avoidable_collisions, 0);
  EXPECT_EQ(result.verdict, Verdict::kForced);
  Criteria criteria;
  criteria.mission_done = false;
  EXPECT_THAT(score(record, criteria).failures, IsEmpty()) << "it is not the vehicle's collision";
  record.contact->replay = {false, false};
  record.contact->truth.yielding = false;
  EXPECT_EQ(score(record).avoidable_collisions, 1);
  record.contact->truth.yielding = true;
  record.contact->truth.walker_in_field_s = 2.0;
  EXPECT_EQ(score(record).verdict, Verdict::kStruck);
  EXPECT_THAT(score(record, criteria).failures, ElementsAre("collision (struck): touched `walker_0`"));
}

TEST_F(FlightScoring, AFlightThatNeverTookOffFails) {
  FlightRecord record;
  record.flight_time_s = 300;
  const FlightScore result = score(record);
  EXPECT_EQ(result.outcome, "not finished after 300 s");
  EXPECT_FALSE(result.figure("coverage") || result.figure("goal_error_m") || result.figure("estimate_rms_m") ||
               result.figure("map_wall_error_median_m"));
  EXPECT_FALSE(result.passed());
}

TEST(CriteriaConfig, NanMeetsNoCriterion) {
  FlightScore score;
  score.mission_done = true;
  score["estimate_rms_m"] = std::numeric_limits<double>::quiet_NaN();
  Criteria criteria;
  criteria["estimate_rms_max_m"] = 0.05;
  EXPECT_EQ(missed(score, criteria).size(), 1u);
}

TEST(CriteriaConfig, OutOfBoundsCriteriaAreRefused) {
  Criteria criteria;
  EXPECT_THAT(common::config::problemsOf(criteria), IsEmpty());
  criteria["coverage_min"] = 99;  // Meant as per cent.
  criteria["goal_error_max_m"] = -1;
  EXPECT_EQ(common::config::problemsOf(criteria).size(), 2u);
}

}  // namespace
}  // namespace swiftlet::evaluation
