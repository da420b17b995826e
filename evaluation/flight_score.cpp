#include "evaluation/flight_score.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "evaluation/map_metrics.hpp"
#include "evaluation/statistics.hpp"
#include "evaluation/verdict_facts.hpp"
#include "simulation/nature.hpp"
#include "simulation/truth_map.hpp"

namespace swiftlet::evaluation {
namespace {

using common::MissionState;

std::optional<double> rmsOf(const std::vector<double>& errors) {
  if (errors.empty()) return std::nullopt;
  return statisticsOf(errors).rmse;
}

std::optional<double> worstOf(const std::vector<ReachedGoal>& goals, bool home, double ReachedGoal::*error) {
  std::optional<double> worst;
  for (const ReachedGoal& goal : goals)
    if (goal.home == home) worst = std::max(goal.*error, worst.value_or(0.0));
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
  score.avoidable_collisions = acceptable(score.verdict) ? 0 : 1;
  score.glass_contacts = score.verdict == Verdict::kUnseen ? 1 : 0;
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

  const double laser_m = cruise_m + world.laser.mount.z_m;
  if (const auto error = wallError(*record.map, T_world_map, *world.rays, laser_m)) {
    score.map_wall_error_median_m = error->median_m;
    score.map_wall_error_p95_m = error->p95_m;
  }
  if (const auto error = wallError(*record.map, common::planar(record.T_world_start), *world.rays, laser_m))
    score.map_wall_error_median_raw_m = error->median_m;
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

ConductScore scoreOf(const ConductRecord& record, const TrueWorld& world) {
  ConductScore score;
  if (record.airborne_s > 0) {
    score.tilted_share = record.tilted_s / record.airborne_s;
    score.tilt_max_deg = record.tilt_max_rad / common::kRadPerDeg;
  }
  if (record.charge_min)
    score.thrust_margin_min = simulation::thrustOverWeight(world.vehicle, world.quadrotor, *record.charge_min,
                                                           simulation::Nature::kFullThrottle);
  score.touch_down_speed_m_s = record.touch_down_speed_m_s;
  score.safe_action_s = record.safe_action_s;
  if (record.home_energy) {
    const auto [predicted, needed] = *record.home_energy;
    score.home_energy_predicted = predicted;
    score.home_energy_needed = needed;
    if (needed > 0) score.home_energy_error = std::abs(predicted - needed) / needed;
  }
  if (!record.laser_latencies_s.empty()) {
    score.laser_latency_median_s = quantile(record.laser_latencies_s, 0.5);
    score.laser_latency_p95_s = quantile(record.laser_latencies_s, 0.95);
  }
  return score;
}

}  // namespace

FlightScore scoreOf(const FlightRecord& record, const TrueWorld& world, const Criteria& criteria, std::int64_t seed,
                    double wall_time_s, const common::MachineUse& machine) {
  FlightScore score;
  score.seed = seed;
  score.outcome = outcomeOf(record);
  score.mission_begun = record.mission != MissionState::kReady;
  score.mission_done = record.mission == MissionState::kDone && !record.last_truth.crashed;
  score.goal_error_m = worstOf(record.goals, false, &ReachedGoal::error_m);
  score.home_error_m = worstOf(record.goals, true, &ReachedGoal::error_m);
  score.goal_error_raw_m = worstOf(record.goals, false, &ReachedGoal::error_raw_m);
  score.home_error_raw_m = worstOf(record.goals, true, &ReachedGoal::error_raw_m);
  score.visits = markerVisits(record.goals);
  score.marker_error_m = markerError_m(score.visits);
  score.relocalization_error_m = relocalizationError_m(score.visits);
  score.open_loop_error_m = openLoopError_m(score.visits);
  score.estimate_rms_m = rmsOf(record.horizontal_errors_m);
  score.estimate_rms_raw_m = rmsOf(record.horizontal_errors_raw_m);
  score.estimate_spatial_rms_m = rmsOf(record.spatial_errors_m);
  score.estimate_yaw_rms_rad = rmsOf(record.yaw_errors_rad);
  const Judgement judgement = judge(factsOf(record, world));
  score.verdict = judgement.verdict;
  score.verdict_reason = judgement.reason;
  scoreCollision(record.last_truth, score);
  scoreMap(record, world, score);
  score.map3d = scoreMap3d(record, world);
  if (record.visual_odometry) score.visual_odometry = scoreOf(*record.visual_odometry, record.truth_map);
  score.conduct = scoreOf(record.conduct, world);
  score.behaviors = scoreOf(record.behaviors, world, record.T_world_map, record.T_world_body_views);
  if (record.localization) score.localization = scoreOf(*record.localization, criteria.localized_within_m);
  score.phases = record.phases;
  score.operator_answers = record.operator_answers;
  score.mission_time_s = record.mission_time_s;
  score.flight_time_s = record.flight_time_s;
  score.distance_m = record.true_distance_m;
  score.end_distance_m = (record.last_truth.T_world_body.position_m - record.T_world_start.position_m).head<2>().norm();
  score.speed_max_m_s = record.true_speed_max_m_s;
  if (record.explored_area_m2 > 0) score.explored_area_m2 = record.explored_area_m2;
  score.interruptions = record.interruptions;
  score.resumed = record.resumed;
  if (wall_time_s > 0) score.realtime_factor = record.flight_time_s / wall_time_s;
  score.machine = machine;
  score.failures = missed(score, criteria);
  return score;
}

std::vector<std::pair<const char*, std::optional<double>>> figuresOf(const ConductScore& score) {
  return {{"tilted_share", score.tilted_share},
          {"tilt_max_deg", score.tilt_max_deg},
          {"thrust_margin_min", score.thrust_margin_min},
          {"touch_down_speed_m_s", score.touch_down_speed_m_s},
          {"safe_action_s", score.safe_action_s},
          {"home_energy_predicted", score.home_energy_predicted},
          {"home_energy_needed", score.home_energy_needed},
          {"home_energy_error", score.home_energy_error},
          {"laser_latency_median_s", score.laser_latency_median_s},
          {"laser_latency_p95_s", score.laser_latency_p95_s}};
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
  add("goal_error_raw_m", score.goal_error_raw_m);
  add("home_error_raw_m", score.home_error_raw_m);
  add("estimate_rms_raw_m", score.estimate_rms_raw_m);
  add("map_wall_error_median_raw_m", score.map_wall_error_median_raw_m);
  if (score.map3d) {
    add("map3d_error_median_m", score.map3d->error_median_m);
    add("map3d_error_p95_m", score.map3d->error_p95_m);
    add("map3d_aligned_median_m", score.map3d->aligned_median_m);
    add("map3d_aligned_p95_m", score.map3d->aligned_p95_m);
    add("map3d_coverage", score.map3d->coverage);
    if (const auto& camera = score.map3d->camera) {
      add("camera_mount_error_rad", camera->mount_rad);
      add("camera_mount_error_of_data_sheet_rad", camera->sheet_rad);
      add("camera_clock_error_s", camera->clock_s);
    }
  }
  if (score.visual_odometry) {
    add("visual_odometry_rms_m", score.visual_odometry->rms_m);
    add("visual_odometry_lost_share", score.visual_odometry->lost_share);
  }
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
  for (const auto& [name, figure] : figuresOf(score.conduct)) add(name, figure);
  for (const auto& [name, figure] : figuresOf(score.behaviors)) add(name, figure);
  for (const PhaseScore& phase : score.phases)
    for (const auto& [name, figure] : phase.figures) figures.emplace_back(phase.name + "." + name, figure);
  return figures;
}

}  // namespace swiftlet::evaluation
