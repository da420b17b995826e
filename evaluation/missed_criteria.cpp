// The criteria of one flight.
#include <fmt/format.h>

#include "evaluation/flight_score.hpp"
#include "evaluation/judge.hpp"

namespace swiftlet::evaluation {
namespace {

using Figure = std::optional<double>;

/// The end of the flight. Where verdicts are required, crashes and needless landings are judged over all flights,
/// see TrialResult::missed().
void judgeEnding(const FlightScore& score, const Criteria& criteria, Judge& judge) {
  if (criteria.mission_done && !score.mission_done) judge.fail(fmt::format("mission: {}", score.outcome));
  if (!criteria.verdicts) {
    if (score.avoidable_collisions > criteria.collisions_max) judge.fail(fmt::format("collision: {}", score.collision));
  } else if (score.verdict == Verdict::kOutside || score.verdict == Verdict::kUnfinished) {
    judge.fail(fmt::format("verdict {}: {}", toString(score.verdict), score.verdict_reason));
  }
}

void judgeMap3d(const std::optional<Map3dScore>& map, const Criteria& criteria, Judge& judge) {
  const auto figure = [&](double Map3dScore::*member) { return map ? Figure((*map).*member) : std::nullopt; };
  judge.atMost("3D map error, m", figure(&Map3dScore::error_median_m), criteria.map3d_error_max_m);
  judge.atMost("3D map error aligned, m", figure(&Map3dScore::aligned_median_m), criteria.map3d_aligned_error_max_m);
  judge.atMost("3D map error aligned of 95 %, m", figure(&Map3dScore::aligned_p95_m), criteria.map3d_aligned_p95_max_m);
  judge.atLeast("3D map coverage", map ? map->coverage : std::nullopt, criteria.map3d_coverage_min);
}

/// What a mission that was done must have reached.
void judgeMission(const FlightScore& score, const Criteria& criteria, Judge& judge) {
  judge.atLeast("coverage", score.coverage, criteria.coverage_min, score.coverage_problem);
  judge.atMost("goal error, m", score.goal_error_m, criteria.goal_error_max_m);
  judge.atMost("home error, m", score.home_error_m, criteria.home_error_max_m);
  judge.atMost("marker error, m", score.marker_error_m, criteria.marker_error_max_m);
  judge.atMost("relocalization error, m", score.relocalization_error_m, criteria.relocalization_error_max_m);
  judge.atMost("mission time, s", score.mission_begun ? Figure(score.mission_time_s) : std::nullopt,
               criteria.mission_time_max_s);
  judge.atMost("estimate RMS, m", score.estimate_rms_m, criteria.estimate_rms_max_m);
  judge.atMost("estimate RMS in space, m", score.estimate_spatial_rms_m, criteria.estimate_spatial_rms_max_m);
  judge.atMost("map wall error, m", score.map_wall_error_median_m, criteria.map_wall_error_max_m);
  judgeMap3d(score.map3d, criteria, judge);
  judge.atMost("share of the time localized wrongly",
               score.localization ? Figure(score.localization->wrong_share) : std::nullopt,
               criteria.wrong_time_share_max);
  if (criteria.all_resumed && score.resumed < score.interruptions)
    judge.fail(fmt::format("interruptions: {} of {} went on", score.resumed, score.interruptions));
}

/// Criteria of single steps apply to every flight, however it ended.
void judgeSteps(const FlightScore& score, Judge& judge) {
  for (const PhaseScore& phase : score.phases)
    for (std::string& failure : phase.missed()) judge.fail(std::move(failure));
  for (const OperatorAnswer& answer : score.operator_answers)
    if (std::string failure = answer.failure(); !failure.empty()) judge.fail(std::move(failure));
}

void judgeConduct(const ConductScore& conduct, const Criteria& criteria, bool lacking_counts, Judge& judge) {
  const auto atMost = [&](const char* name, const Figure& value, double bound) {
    if (value || lacking_counts) judge.atMost(name, value, bound);
  };
  atMost("share of the time tilted", conduct.tilted_share, criteria.tilted_share_max);
  if (conduct.thrust_margin_min || lacking_counts)
    judge.atLeast("thrust margin", conduct.thrust_margin_min, criteria.thrust_margin_min);
  atMost("touch-down speed, m/s", conduct.touch_down_speed_m_s, criteria.touch_down_speed_max_m_s);
  // However the flight ended: without the figure its fault never began, and the trial tested nothing.
  judge.atMost("time from fault to safe action, s", conduct.safe_action_s, criteria.safe_action_max_s);
  atMost("error of the energy for the flight home", conduct.home_energy_error, criteria.home_energy_error_max);
}

/// Criteria of behaviours apply to every flight.
void judgeBehaviors(const BehaviorScore& behaviors, const Criteria& criteria, Judge& judge) {
  judge.atLeast("distance from keep-out zones, m", behaviors.keep_out_gap_m, criteria.keep_out_gap_min_m);
  judge.atMost("angle to the inspected point, deg", behaviors.inspect_axis_max_deg, criteria.inspect_axis_max_deg);
  judge.atLeast("share of the surveyed floor that was seen", behaviors.survey_coverage, criteria.survey_coverage_min);
  judge.atLeast("share of the time at the distance of following", behaviors.follow_share, criteria.follow_share_min);
  judge.atMost("time in which the person was lost, s", behaviors.follow_lost_s, criteria.follow_lost_max_s);
  judge.atLeast("share of the targets that were found", behaviors.targets_found, criteria.targets_found_min);
  judge.atMost("error of a target's place, m", behaviors.target_error_max_m, criteria.target_error_max_m);
  judge.atMost("targets that are none", behaviors.false_targets, criteria.false_targets_max);
}

void judgeDistances(const FlightScore& score, const Criteria& criteria, Judge& judge) {
  judge.atMost("distance from the take-off place at the end, m", score.end_distance_m, criteria.end_distance_max_m);
  if (!score.mission_done)
    judge.atLeast("distance flown without having done the mission, m", score.distance_m,
                  criteria.unfinished_distance_min_m);
}

/// Criteria of the computer apply to every flight, however it ended.
void judgeMachine(const common::MachineUse& machine, const Criteria& criteria, Judge& judge) {
  judge.atMost("memory, MB", machine.memory_peak_MB, criteria.memory_max_MB);
  judge.atMost("camera frame at the end over one at the start", machine.frameGrowth(), criteria.frame_growth_max);
}

}  // namespace

std::vector<std::string> missed(const FlightScore& score, const Criteria& criteria) {
  Judge judge;
  judgeEnding(score, criteria, judge);
  const bool asked_of_mission = score.mission_done || !criteria.verdicts;
  if (asked_of_mission) judgeMission(score, criteria, judge);
  judgeConduct(score.conduct, criteria, asked_of_mission, judge);
  judgeBehaviors(score.behaviors, criteria, judge);
  judgeDistances(score, criteria, judge);
  judgeMachine(score.machine, criteria, judge);
  judgeSteps(score, judge);
  return judge.failures;
}

}  // namespace swiftlet::evaluation
