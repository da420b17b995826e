#include "planning/exploration/viewpoint_options.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace swiftlet::planning {
namespace {

/// Utility grows with the gain to this power; at 0 only the travel time counts.
constexpr double kGainExponent = 0.6;
/// Share of the utility that is lost where the laser would not fix the pose.
constexpr double kLocalizabilityWeight = 0.3;

}  // namespace

double travelTime_s(double path_m, double from_yaw_rad, double to_yaw_rad) {
  const double turn_rad = std::abs(common::wrapAngle(to_yaw_rad - from_yaw_rad));
  return std::max(path_m / kTravelSpeed_m_s, turn_rad / kTravelYawRate_rad_s);
}

std::optional<ViewpointOption> ViewpointOptions::bestOf(const SeenFrontier& seen) {
  return chosenOf(seen, [](const ViewpointOption& a, const ViewpointOption& b) { return a.utility > b.utility; });
}

/// Lookouts are ordered by rings around the frontier; the first one is in the nearest ring.
std::optional<ViewpointOption> ViewpointOptions::nearestOf(const SeenFrontier& seen) {
  return chosenOf(seen, [](const ViewpointOption&, const ViewpointOption&) { return false; });
}

template <typename IsBetter>
std::optional<ViewpointOption> ViewpointOptions::chosenOf(const SeenFrontier& seen, IsBetter&& is_better) {
  std::optional<ViewpointOption> best;
  bool best_is_new = false;
  double greatest_gain_m2 = 0.0;
  for (const Lookout& lookout : seen.lookouts) {
    const ViewpointOption option = optionAt(seen.number, lookout);
    greatest_gain_m2 = std::max(greatest_gain_m2, option.view.gain_m2);
    if (option.view.gain_m2 < kMinGain_m2) continue;
    const bool is_new = !survey_.lookedFrom(lookout);
    if (best && (is_new != best_is_new ? best_is_new : !is_better(option, *best))) continue;
    best = option;
    best_is_new = is_new;
  }
  if (!best) leaveUnseen(seen.number, greatest_gain_m2);
  return best;
}

/// As too small if even a view from the frontier itself sees too little, otherwise as unreachable.
void ViewpointOptions::leaveUnseen(std::size_t frontier, double greatest_gain_m2) {
  const std::vector<common::CellIndex>& cells = survey_.run(frontier).cells;
  const double at_it_m2 = scout_.view(cells[cells.size() / 2], 0.0).gain_m2;
  if (at_it_m2 < kMinGain_m2) {
    survey_.leave(frontier, common::FrontierReason::kTooSmall, fmt::format("{:.2f} m2 to be seen", greatest_gain_m2));
  } else {
    survey_.leave(frontier, common::FrontierReason::kUnreachable,
                  fmt::format("from where one can be at clearance {:.2f} m only {:.2f} of {:.2f} m2 are seen",
                              survey_.map().footprint().clearance_m, greatest_gain_m2, at_it_m2));
  }
}

ViewpointOption ViewpointOptions::optionAt(std::size_t frontier, const Lookout& lookout) const {
  ViewpointOption option{frontier, lookout, {}, 0.0};
  const CostMap& map = survey_.map();
  const Eigen::Vector2d towards_target_m = map.centerOf(lookout.target) - map.centerOf(lookout.place);
  option.view = scout_.view(lookout.place, std::atan2(towards_target_m.y(), towards_target_m.x()));
  const double trust = 1.0 - kLocalizabilityWeight * (1.0 - option.view.localizability);
  option.utility = trust * std::pow(option.view.gain_m2, kGainExponent) /
                   (travelTime_s(lookout.path_m, input_.pose_map.yaw_rad, option.view.yaw_map_rad) + kBrake_s);
  return option;
}

double ViewpointOptions::utilityBound(double path_m) const {
  const double field_of_view_rad = config_.laser_field_of_view_deg * std::numbers::pi / 180.0;
  const double depth_m = Scout::kGainDepth_m + 2.0 * survey_.map().resolution_m();
  const double free_m = std::max(0.0, config_.laser_range_m - depth_m);
  const double gain_m2 = 0.5 * field_of_view_rad * (config_.laser_range_m * config_.laser_range_m - free_m * free_m);
  return std::pow(gain_m2, kGainExponent) / (path_m / kTravelSpeed_m_s + kBrake_s);
}

std::optional<ViewpointOption> ViewpointOptions::current(const std::vector<std::size_t>& frontiers) const {
  const std::optional<std::size_t> frontier = survey_.ofCurrent(frontiers);
  if (!frontier) return std::nullopt;
  ViewpointOption option = optionAt(*frontier, survey_.currentLookout());
  if (option.view.gain_m2 < kMinGain_m2) return std::nullopt;
  option.view.yaw_map_rad = input_.current->pose_map.yaw_rad;
  return option;
}

Viewpoint ViewpointOptions::viewpointOf(const ViewpointOption& option) const {
  const Eigen::Vector2d place_m = survey_.map().centerOf(option.lookout.place);
  return {{place_m.x(), place_m.y(), option.view.yaw_map_rad},
          survey_.map().centerOf(option.lookout.target),
          option.view.gain_m2,
          option.utility};
}

}  // namespace swiftlet::planning
