#include "evaluation/trial_figures.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "common/check.hpp"
#include "common/error.hpp"
#include "evaluation/statistics.hpp"

namespace swiftlet::evaluation {
namespace {

/// A figure of a flight by the pointer to its member.
template <auto kMember>
std::optional<double> of(const FlightScore& flight) {
  if constexpr (requires { flight.*kMember; })
    return flight.*kMember;
  else if constexpr (requires { flight.conduct.*kMember; })
    return flight.conduct.*kMember;
  else
    return flight.behaviors.*kMember;
}

std::optional<double> timeIfDone_s(const FlightScore& flight) {
  return flight.mission_done ? std::optional(flight.mission_time_s) : std::nullopt;
}
std::optional<double> localizedInTime(const FlightScore& flight) {
  return flight.localization ? std::optional(flight.localization->in_time ? 1.0 : 0.0) : std::nullopt;
}
std::optional<double> localizationPathLength_m(const FlightScore& flight) {
  return flight.localization ? flight.localization->path_length_m : std::nullopt;
}
std::optional<double> wrongShare(const FlightScore& flight) {
  return flight.localization ? std::optional(flight.localization->wrong_share) : std::nullopt;
}
template <auto kMember>
std::optional<double> ofMap3d(const FlightScore& flight) {
  return flight.map3d ? std::optional((*flight.map3d).*kMember) : std::nullopt;
}
std::optional<double> map3dCoverage(const FlightScore& flight) {
  return flight.map3d ? flight.map3d->coverage : std::nullopt;
}
std::optional<double> visualOdometryRms_m(const FlightScore& flight) {
  return flight.visual_odometry ? flight.visual_odometry->rms_m : std::nullopt;
}
std::optional<double> visualOdometryLostShare(const FlightScore& flight) {
  return flight.visual_odometry ? std::optional(flight.visual_odometry->lost_share) : std::nullopt;
}
std::optional<double> memoryPeak_MB(const FlightScore& flight) { return flight.machine.memory_peak_MB; }
std::optional<double> frameGrowth(const FlightScore& flight) { return flight.machine.frameGrowth(); }
std::optional<double> planMedian_ms(const FlightScore& flight) { return flight.machine.plan_median_ms; }
std::optional<double> planMax_ms(const FlightScore& flight) { return flight.machine.plan_max_ms; }
template <Verdict kVerdict>
std::optional<double> is(const FlightScore& flight) {
  return flight.verdict == kVerdict ? 1.0 : 0.0;
}

}  // namespace

const std::vector<TrialFigure>& trialFigures() {
  using Score = FlightScore;
  using Conduct = ConductScore;
  using enum Statistic;
  static const std::vector<TrialFigure> figures = {
      {"done_share", kMean, is<Verdict::kDone>},
      {"needless_share", kMean, is<Verdict::kNeedless>},
      {"coverage_min", kMin, of<&Score::coverage>},
      {"goal_error_max_m", kMax, of<&Score::goal_error_m>},
      {"goal_error_median_m", kMedian, of<&Score::goal_error_m>},
      {"home_error_max_m", kMax, of<&Score::home_error_m>},
      {"home_error_median_m", kMedian, of<&Score::home_error_m>},
      {"marker_error_max_m", kMax, of<&Score::marker_error_m>},
      {"marker_error_median_m", kMedian, of<&Score::marker_error_m>},
      {"relocalization_error_max_m", kMax, of<&Score::relocalization_error_m>},
      {"relocalization_error_median_m", kMedian, of<&Score::relocalization_error_m>},
      {"mission_time_median_s", kMedian, timeIfDone_s},
      {"distance_median_m", kMedian, of<&Score::distance_m>},
      {"flight_time_median_s", kMedian, of<&Score::flight_time_s>},
      {"estimate_rms_median_m", kMedian, of<&Score::estimate_rms_m>},
      {"map_wall_error_median_m", kMedian, of<&Score::map_wall_error_median_m>},
      {"map3d_error_median_m", kMedian, ofMap3d<&Map3dScore::error_median_m>},
      {"map3d_error_max_m", kMax, ofMap3d<&Map3dScore::error_median_m>},
      {"map3d_aligned_error_max_m", kMax, ofMap3d<&Map3dScore::aligned_median_m>},
      {"map3d_aligned_p95_max_m", kMax, ofMap3d<&Map3dScore::aligned_p95_m>},
      {"map3d_coverage_min", kMin, map3dCoverage},
      {"visual_odometry_rms_median_m", kMedian, visualOdometryRms_m},
      {"visual_odometry_lost_share_max", kMax, visualOdometryLostShare},
      {"localized_flights", kMean, localizedInTime},
      {"localization_path_length_median_m", kMedian, localizationPathLength_m},
      {"localization_path_length_max_m", kMax, localizationPathLength_m},
      {"wrong_time_share_max", kMax, wrongShare},
      {"tilted_share_max", kMax, of<&Conduct::tilted_share>},
      {"thrust_margin_min", kMin, of<&Conduct::thrust_margin_min>},
      {"touch_down_speed_max_m_s", kMax, of<&Conduct::touch_down_speed_m_s>},
      {"safe_action_max_s", kMax, of<&Conduct::safe_action_s>},
      {"keep_out_gap_min_m", kMin, of<&BehaviorScore::keep_out_gap_m>},
      {"inspect_axis_max_deg", kMax, of<&BehaviorScore::inspect_axis_max_deg>},
      {"survey_coverage_min", kMin, of<&BehaviorScore::survey_coverage>},
      {"follow_share_min", kMin, of<&BehaviorScore::follow_share>},
      {"follow_first_share_min", kMin, of<&BehaviorScore::follow_first_share>},
      {"follow_last_share_min", kMin, of<&BehaviorScore::follow_last_share>},
      {"follow_lost_max_s", kMax, of<&BehaviorScore::follow_lost_s>},
      {"targets_found_min", kMin, of<&BehaviorScore::targets_found>},
      {"target_error_max_m", kMax, of<&BehaviorScore::target_error_max_m>},
      {"target_error_median_m", kMedian, of<&BehaviorScore::target_error_median_m>},
      {"false_targets_max", kMax, of<&BehaviorScore::false_targets>},
      {"home_energy_error_max", kMax, of<&Conduct::home_energy_error>},
      {"goal_error_max_raw_m", kMax, of<&Score::goal_error_raw_m>},
      {"goal_error_median_raw_m", kMedian, of<&Score::goal_error_raw_m>},
      {"home_error_max_raw_m", kMax, of<&Score::home_error_raw_m>},
      {"home_error_median_raw_m", kMedian, of<&Score::home_error_raw_m>},
      {"estimate_rms_median_raw_m", kMedian, of<&Score::estimate_rms_raw_m>},
      {"map_wall_error_median_raw_m", kMedian, of<&Score::map_wall_error_median_raw_m>},
      {"realtime_factor_median", kMedian, of<&Score::realtime_factor>},
      {"memory_peak_MB", kMax, memoryPeak_MB},
      {"frame_growth_max", kMax, frameGrowth},
      {"plan_time_median_ms", kMedian, planMedian_ms},
      {"plan_time_max_ms", kMax, planMax_ms},
  };
  return figures;
}

std::string trialFigureProblem(const std::string& name) {
  std::vector<std::string> names;
  for (const TrialFigure& figure : trialFigures()) names.emplace_back(figure.name);
  if (std::find(names.begin(), names.end(), name) != names.end()) return {};
  return toString(common::Problem{
      {}, "", fmt::format("`{}` is not a figure over all flights", name), common::didYouMean(name, names)});
}

std::optional<double> valueOf(const TrialFigure& figure, const std::vector<FlightScore>& flights) {
  std::vector<double> values;
  for (const FlightScore& flight : flights)
    if (const std::optional<double> value = figure.of(flight)) values.push_back(*value);
  if (values.empty()) return std::nullopt;
  switch (figure.statistic) {
    case Statistic::kMin:
      return quantile(values, 0.0);
    case Statistic::kMedian:
      return quantile(values, 0.5);
    case Statistic::kMax:
      return quantile(values, 1.0);
    case Statistic::kMean:
      return statisticsOf(values).mean;
  }
  return std::nullopt;
}

std::vector<std::int64_t> seedsWithout(const TrialFigure& figure, const std::vector<FlightScore>& flights) {
  std::vector<std::int64_t> seeds;
  for (const FlightScore& flight : flights)
    if (!figure.of(flight)) seeds.push_back(flight.seed);
  return seeds;
}

std::optional<double> trialFigure(std::string_view name, const std::vector<FlightScore>& flights) {
  for (const TrialFigure& figure : trialFigures())
    if (name == figure.name) return valueOf(figure, flights);
  SWIFTLET_CHECK(false, std::string(name));
}

std::optional<double> medianOverAll(std::optional<double> FlightScore::*figure,
                                    const std::vector<FlightScore>& flights) {
  if (flights.empty()) return std::nullopt;
  std::vector<double> values;
  for (const FlightScore& flight : flights)
    values.push_back((flight.*figure).value_or(std::numeric_limits<double>::max()));
  return quantile(values, 0.5);
}

}  // namespace swiftlet::evaluation
