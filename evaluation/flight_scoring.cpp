#include "evaluation/flight_scoring.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/quantile.hpp"
#include "common/square.hpp"
#include "evaluation/figure_measures.hpp"
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
  if (record.contact) return record.contact->what;
  const MissionRecord& mission = record.mission;
  if (mission.state == MissionState::kDone) return "done";
  if (mission.state == MissionState::kFailed) return "mission failed: " + mission.reason;
  if (mission.state == MissionState::kStopped) return "mission stopped: " + mission.reason;
  return fmt::format("not finished after {:.0f} s", record.flight_time_s);
}

void measureCollision(const FlightRecord& record, FlightScore& score) {
  score["min_clearance_m"] = record.last_truth.min_clearance_m;
  score["min_walker_clearance_m"] = record.last_truth.min_walker_clearance_m;
  score["floor_contact_s"] = record.contact ? record.contact->floor_s : 0.0;
  if (!record.contact) return;
  score.collisions = 1;
  score.collision = record.contact->what;
  score.avoidable_collisions = score.verdict == Verdict::kForced ? 0 : 1;
  score.glass_contacts = record.contact->truth.unseen_glass ? 1 : 0;
}

void measureMap(const FlightRecord& record, const TrueWorld& world, FlightScore& score) {
  if (record.map == nullptr || record.estimate.horizontal_errors_m.empty()) return;
  const common::Pose2 T_world_map = common::planar(record.T_world_map);
  const double cruise_m = record.cruise_height_world_m, half_height_m = 0.5 * world.vehicle.hull_height_m;

  simulation::FreeSpaceQuery query;
  query.start_world_m = T_world_map.position_m();
  query.hull_radius_m = world.vehicle.hullRadius_m() + world.clearance_m;
  query.bottom_m = cruise_m - half_height_m;
  query.top_m = cruise_m + half_height_m;
  query.resolution_m = record.map->resolution_m();
  query.max_area_m2 = world.reachable_area_max_m2;
  query.closed_doors = record.last_truth.closed_doors;
  const simulation::FreeSpace free_space = simulation::freeSpace(*world.rays, query);
  if (free_space.isOpen(query)) {
    score.coverage_problem = fmt::format("the world is not closed: the hull gets from the start to more than {:g} m2",
                                         world.reachable_area_max_m2);
  } else {
    score["coverage"] = coverage(*record.map, T_world_map, free_space);
    if (free_space.covered_area_m2 > 0) score["reachable_area_m2"] = free_space.covered_area_m2;
  }

  const double laser_m = cruise_m + world.laser.mount.z_m;
  if (const auto error = wallError(*record.map, T_world_map, *world.rays, laser_m, query.closed_doors)) {
    score["map_wall_error_median_m"] = error->median_m;
    score["map_wall_error_p95_m"] = error->p95_m;
  }
  if (const auto error =
          wallError(*record.map, common::planar(record.T_world_start), *world.rays, laser_m, query.closed_doors))
    score["map_wall_error_median_raw_m"] = error->median_m;
}

void measureLocalization(const LocalizationRecord& record, double within_m, FlightScore& score) {
  const auto& found = record.found;
  const bool in_time = found && found->path_length_m <= within_m && found->error_m <= LocalizationRecord::kWrong_m &&
                       found->error_rad <= LocalizationRecord::kWrong_rad;
  score["localized_in_time"] = in_time ? 1.0 : 0.0;
  if (found) {
    score["localization_path_length_m"] = found->path_length_m;
    score["localization_error_m"] = found->error_m;
    score["localization_error_rad"] = found->error_rad;
  }
  score["localized_time_share"] = record.flown_s > 0 ? record.localized_s / record.flown_s : 0.0;
  score["wrong_time_share"] = record.localized_s > 0 ? record.wrong_s / record.localized_s : 0.0;
  score["times_lost"] = record.times_lost;
}

void measureConduct(const ConductRecord& record, const TrueWorld& world, FlightScore& score) {
  if (record.airborne_s > 0) {
    score["tilted_share"] = record.tilted_s / record.airborne_s;
    score["tilt_max_deg"] = record.tilt_max_rad / common::kRadPerDeg;
  }
  if (record.charge_min)
    score["thrust_margin_min"] = simulation::thrustOverWeight(world.vehicle, world.quadrotor, *record.charge_min,
                                                              simulation::Nature::kFullThrottle, record.lost_cells);
  score["touch_down_speed_m_s"] = record.touch_down_speed_m_s;
  score["safe_action_s"] = record.safe_action_s;
  if (record.home_energy) {
    const auto [predicted, needed] = *record.home_energy;
    score["home_energy_predicted"] = predicted;
    score["home_energy_needed"] = needed;
    if (needed > 0) score["home_energy_error"] = std::abs(predicted - needed) / needed;
  }
  if (!record.laser_latencies_s.empty()) {
    score["laser_latency_median_s"] = common::quantile(record.laser_latencies_s, 0.5);
    score["laser_latency_p95_s"] = common::quantile(record.laser_latencies_s, 0.95);
  }
}

void measureGoals(const FlightRecord& record, FlightScore& score) {
  score["goal_error_m"] = worstOf(record.goals, false, &ReachedGoal::error_m);
  score["home_error_m"] = worstOf(record.goals, true, &ReachedGoal::error_m);
  score["goal_error_raw_m"] = worstOf(record.goals, false, &ReachedGoal::error_raw_m);
  score["home_error_raw_m"] = worstOf(record.goals, true, &ReachedGoal::error_raw_m);
  score.visits = markerVisits(record.goals);
  score["marker_error_m"] = markerError_m(score.visits);
  score["relocalization_error_m"] = relocalizationError_m(score.visits);
  score["open_loop_error_m"] = openLoopError_m(score.visits);
}

void measureEstimate(const EstimateRecord& record, FlightScore& score) {
  score["estimate_rms_m"] = rmsOf(record.horizontal_errors_m);
  score["estimate_rms_raw_m"] = rmsOf(record.horizontal_errors_raw_m);
  score["estimate_spatial_rms_m"] = rmsOf(record.spatial_errors_m);
  if (!record.spatial_errors_m.empty()) score["height_error_m"] = record.greatest_height_error_m;
  score["estimate_yaw_rms_rad"] = rmsOf(record.yaw_errors_rad);
  if (record.mahalanobis_distances.empty()) return;
  // Exceeded by one in 450 where two degrees of freedom are Gaussian.
  constexpr double kOutside = 3.5;
  const auto outside = std::count_if(record.mahalanobis_distances.begin(), record.mahalanobis_distances.end(),
                                     [](double distance) { return distance > kOutside; });
  score["position_outside_share"] =
      static_cast<double>(outside) / static_cast<double>(record.mahalanobis_distances.size());
  score["position_mahalanobis_mean_square"] = common::square(*rmsOf(record.mahalanobis_distances));
}

void measureCourse(const FlightRecord& record, double wall_time_s, FlightScore& score) {
  if (record.mission.state != MissionState::kReady) score["mission_time_s"] = record.mission.time_s;
  score["flight_time_s"] = record.flight_time_s;
  score["distance_m"] = record.true_distance_m;
  score["end_distance_m"] =
      (record.last_truth.T_world_body.position_m - record.T_world_start.position_m).head<2>().norm();
  score["speed_max_m_s"] = record.true_speed_max_m_s;
  if (record.explored_area_m2 > 0) score["explored_area_m2"] = record.explored_area_m2;
  score["realtime_factor"] = wall_time_s > 0 ? record.flight_time_s / wall_time_s : 0.0;
}

}  // namespace

FlightScore scoreOf(const FlightRecord& record, const TrueWorld& world, const Criteria& criteria, std::int64_t seed,
                    double wall_time_s, const common::MachineUse& machine) {
  FlightScore score;
  score.seed = seed;
  score.outcome = outcomeOf(record);
  const Judgement judgement = judge(factsOf(record, world));
  score.mission_done = judgement.verdict == Verdict::kDone;
  score.verdict = judgement.verdict;
  score.verdict_reason = judgement.reason;
  score.interruptions = record.mission.interruptions;
  score.resumed = record.mission.resumed;
  score.phases = record.phases;
  score.event_orders = record.event_orders;
  score.operator_answers = record.operator_answers;
  score.machine = machine;
  measureGoals(record, score);
  measureEstimate(record.estimate, score);
  if (record.true_distance_m > 0) {
    const ComparedEstimate& end = record.estimate.newest();
    score["end_error_share"] =
        (end.T_map_body.position_m() - end.T_map_truth.position_m()).norm() / record.true_distance_m;
  }
  measureCollision(record, score);
  measureMap(record, world, score);
  measureMap3d(record, world, score);
  if (record.visual_odometry) measureVisualOdometry(*record.visual_odometry, record.estimate.truth_map, score);
  measureConduct(record.conduct, world, score);
  measureBehaviors(record, world, score);
  if (record.localization) measureLocalization(*record.localization, criteria.localized_within_m, score);
  measureCourse(record, wall_time_s, score);
  score.failures = missed(score, criteria);
  return score;
}

}  // namespace swiftlet::evaluation
