#include "evaluation/flight_score.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "evaluation/judge.hpp"
#include "evaluation/map_metrics.hpp"
#include "evaluation/statistics.hpp"
#include "simulation/truth_map.hpp"

namespace swiftlet::evaluation {

using common::config::kPositive;
namespace {

using common::MissionState;

std::optional<double> rmsOf(const std::vector<double>& errors) {
  if (errors.empty()) return std::nullopt;
  return statisticsOf(errors).rmse;
}

std::optional<double> worstOf(const std::vector<ReachedGoal>& goals, bool home) {
  std::optional<double> worst;
  for (const ReachedGoal& goal : goals)
    if (goal.home == home) worst = std::max(goal.error_m, worst.value_or(0.0));
  return worst;
}

std::string outcomeOf(const FlightRecord& record) {
  if (record.last_truth.crashed) return record.last_truth.crash_reason;
  if (record.mission == MissionState::kDone) return "done";
  if (record.mission == MissionState::kFailed) return "mission failed: " + record.mission_reason;
  if (record.mission == MissionState::kStopped) return "mission stopped: " + record.mission_reason;
  return fmt::format("not finished after {:.0f} s", record.flight_time_s);
}

void scoreCollision(const simulation::Truth& truth, FlightScore& score) {
  score.min_clearance_m = truth.min_clearance_m;
  score.min_walker_clearance_m = truth.min_walker_clearance_m;
  if (!truth.crashed) return;
  score.collisions = 1;
  score.collision = truth.crash_reason;
  score.avoidable_collisions = truth.by_walker && truth.yielding ? 0 : 1;
}

/// The flood was stopped by its bound and not by walls, so the coverable area has no end. This is checked before the
/// free space is computed, which would take minutes in the open.
bool isOpen(const simulation::RayCaster& rays, const simulation::FreeSpaceQuery& query) {
  std::size_t cells = 0;
  simulation::reachableSpace(rays, query).forEachCell([&](common::CellIndex, std::uint8_t cell) { cells += cell; });
  return static_cast<double>(cells) * query.resolution_m * query.resolution_m >= query.max_area_m2;
}

void scoreMap(const FlightRecord& record, const TrueWorld& world, FlightScore& score) {
  if (record.map == nullptr || record.horizontal_errors_m.empty()) return;
  const common::Pose2 T_world_map = common::planar(record.T_world_map);
  const double cruise_m = record.cruise_height_world_m, half_height_m = 0.5 * world.vehicle.hull_height_m;

  simulation::FreeSpaceQuery query;
  query.start_world_m = T_world_map.position_m();
  query.hull_radius_m = world.vehicle.hullRadius_m() + world.clearance_m;
  query.bottom_m = cruise_m - half_height_m;
  query.top_m = cruise_m + half_height_m;
  query.resolution_m = record.map->resolution_m();
  query.max_area_m2 = world.reachable_area_max_m2;
  if (isOpen(*world.rays, query)) {
    score.coverage_problem = fmt::format("the world is not closed: the hull gets from the start to more than {:g} m2",
                                         world.reachable_area_max_m2);
  } else {
    const simulation::FreeSpace free_space = simulation::freeSpace(*world.rays, query);
    score.coverage = coverage(*record.map, T_world_map, free_space);
    score.reachable_area_m2 = free_space.covered_area_m2;
  }

  if (const auto error = wallError(*record.map, T_world_map, *world.rays, cruise_m + world.laser.mount.z_m)) {
    score.map_wall_error_median_m = error->median_m;
    score.map_wall_error_p95_m = error->p95_m;
  }
}

LocalizationScore scoreOf(const LocalizationRecord& record, double within_m) {
  LocalizationScore score;
  if (record.found) {
    score.path_length_m = record.found->path_length_m;
    score.error_m = record.found->error_m;
    score.error_rad = record.found->error_rad;
    score.in_time = record.found->path_length_m <= within_m && record.found->error_m <= LocalizationRecord::kWrong_m &&
                    record.found->error_rad <= LocalizationRecord::kWrong_rad;
  }
  if (record.flown_s > 0) score.time_share = record.localized_s / record.flown_s;
  if (record.localized_s > 0) score.wrong_share = record.wrong_s / record.localized_s;
  score.times_lost = record.times_lost;
  return score;
}

}  // namespace

void Criteria::describe(common::config::Fields& fields) {
  fields("mission_done", mission_done, "Whether the mission must end well.");
  fields("collisions_max", collisions_max, {0, 1},
         "Greatest number of touches of anything, a walker that runs into the vehicle included; a flight ends with the "
         "first.");
  fields("coverage_min", coverage_min, {0, 1}, "Least share of the reachable free space that is in the map.");
  fields("goal_error_max_m", goal_error_max_m, kPositive,
         "Greatest distance of the vehicle from a goal that is reported as reached.");
  fields("home_error_max_m", home_error_max_m, kPositive,
         "Greatest distance of the vehicle from home when that is reported as reached.");
  fields("marker_error_max_m", marker_error_max_m, kPositive,
         "Greatest error of the estimate when a goal or home is reported as reached.");
  fields("relocalization_error_max_m", relocalization_error_max_m, kPositive,
         "Greatest difference between the estimate's errors at the same goal at different times.");
  fields("mission_time_max_s", mission_time_max_s, kPositive, "Greatest simulated time of the mission.");
  fields("estimate_rms_max_m", estimate_rms_max_m, kPositive, "Greatest RMS of the estimate's horizontal error.");
  fields("map_wall_error_max_m", map_wall_error_max_m, kPositive,
         "Greatest median distance of mapped walls to true ones.");
  fields("localized_within_m", localized_within_m, kPositive,
         "Path length within which a flight that is given a map must have found itself in it to count as localized.");
  fields("wrong_time_share_max", wrong_time_share_max, kPositive,
         "Greatest share of the time localized in which the estimate is farther than 0.5 m or 10 deg from the truth.");
  fields("all_resumed", all_resumed, "Whether everything that was interrupted must have gone on.");
  fields("goal_error_median_max_m", goal_error_median_max_m, kPositive, "Greatest median of all flights' goal errors.");
  fields("home_error_median_max_m", home_error_median_max_m, kPositive, "Greatest median of all flights' home errors.");
  fields("mission_time_median_max_s", mission_time_median_max_s, kPositive,
         "Greatest median of the times of all missions that ended well.");
  fields("estimate_rms_median_max_m", estimate_rms_median_max_m, kPositive,
         "Greatest median of all flights' RMS errors.");
  fields("map_wall_error_median_max_m", map_wall_error_median_max_m, kPositive,
         "Greatest median of all flights' wall errors.");
  fields("localized_flights_min", localized_flights_min, {0, 1}, "Least share of all flights that were localized.");
}

FlightScore scoreOf(const FlightRecord& record, const TrueWorld& world, const Criteria& criteria, std::int64_t seed,
                    double wall_time_s) {
  FlightScore score;
  score.seed = seed;
  score.outcome = outcomeOf(record);
  score.mission_done = record.mission == MissionState::kDone && !record.last_truth.crashed;
  score.goal_error_m = worstOf(record.goals, false);
  score.home_error_m = worstOf(record.goals, true);
  score.visits = markerVisits(record.goals);
  score.marker_error_m = markerError_m(score.visits);
  score.relocalization_error_m = relocalizationError_m(score.visits);
  score.open_loop_error_m = openLoopError_m(score.visits);
  score.estimate_rms_m = rmsOf(record.horizontal_errors_m);
  score.estimate_spatial_rms_m = rmsOf(record.spatial_errors_m);
  score.estimate_yaw_rms_rad = rmsOf(record.yaw_errors_rad);
  scoreCollision(record.last_truth, score);
  scoreMap(record, world, score);
  if (record.localization) score.localization = scoreOf(*record.localization, criteria.localized_within_m);
  score.mission_time_s = record.mission_time_s;
  score.flight_time_s = record.flight_time_s;
  score.distance_m = record.true_distance_m;
  score.speed_max_m_s = record.true_speed_max_m_s;
  if (record.explored_area_m2 > 0) score.explored_area_m2 = record.explored_area_m2;
  score.interruptions = record.interruptions;
  score.resumed = record.resumed;
  if (wall_time_s > 0) score.realtime_factor = record.flight_time_s / wall_time_s;
  score.failures = missed(score, criteria);
  return score;
}

std::vector<std::pair<std::string, double>> figuresOf(const FlightScore& score) {
  std::vector<std::pair<std::string, double>> figures;
  const auto add = [&](const char* name, const std::optional<double>& value) {
    if (value) figures.emplace_back(name, *value);
  };
  add("goal_error_m", score.goal_error_m);
  add("home_error_m", score.home_error_m);
  add("marker_error_m", score.marker_error_m);
  add("relocalization_error_m", score.relocalization_error_m);
  add("open_loop_error_m", score.open_loop_error_m);
  add("estimate_rms_m", score.estimate_rms_m);
  add("estimate_spatial_rms_m", score.estimate_spatial_rms_m);
  add("estimate_yaw_rms_rad", score.estimate_yaw_rms_rad);
  add("map_wall_error_median_m", score.map_wall_error_median_m);
  add("map_wall_error_p95_m", score.map_wall_error_p95_m);
  if (score.localization) {
    add("localization_path_length_m", score.localization->path_length_m);
    add("localization_error_m", score.localization->error_m);
    add("localization_error_rad", score.localization->error_rad);
    add("localized_time_share", score.localization->time_share);
    add("wrong_time_share", score.localization->wrong_share);
  }
  add("min_clearance_m", score.min_clearance_m);
  if (score.reachable_area_m2 > 0) add("reachable_area_m2", score.reachable_area_m2);
  add("collisions", score.collisions);
  return figures;
}

std::vector<std::string> missed(const FlightScore& score, const Criteria& criteria) {
  Judge judge;
  if (criteria.mission_done && !score.mission_done) judge.fail(fmt::format("mission: {}", score.outcome));
  if (score.collisions > criteria.collisions_max)
    judge.fail(
        fmt::format("collision: {}{}", score.collision, score.avoidable_collisions == 0 ? ", not avoidable" : ""));
  judge.atLeast("coverage", score.coverage, criteria.coverage_min, score.coverage_problem);
  judge.atMost("goal error, m", score.goal_error_m, criteria.goal_error_max_m);
  judge.atMost("home error, m", score.home_error_m, criteria.home_error_max_m);
  judge.atMost("marker error, m", score.marker_error_m, criteria.marker_error_max_m);
  judge.atMost("relocalization error, m", score.relocalization_error_m, criteria.relocalization_error_max_m);
  judge.atMost("mission time, s", score.mission_time_s, criteria.mission_time_max_s);
  judge.atMost("estimate RMS, m", score.estimate_rms_m, criteria.estimate_rms_max_m);
  judge.atMost("map wall error, m", score.map_wall_error_median_m, criteria.map_wall_error_max_m);
  if (score.localization)
    judge.atMost("share of the time localized wrongly", score.localization->wrong_share, criteria.wrong_time_share_max);
  if (criteria.all_resumed && score.resumed < score.interruptions)
    judge.fail(fmt::format("interruptions: {} of {} went on", score.resumed, score.interruptions));
  return judge.failures;
}

}  // namespace swiftlet::evaluation
