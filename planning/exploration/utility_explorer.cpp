// Chooses the viewpoint that shows most for its travel time.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "planning/exploration/frontier_survey.hpp"

namespace swiftlet::planning {
namespace {

using common::FrontierReason;
using Point = Eigen::Vector2d;

/// Frontiers, from the nearest on, for which viewpoints are evaluated in one call.
constexpr std::size_t kMaxEvaluated = 30;
/// A frontier behind which less is expected is left as too small.
constexpr double kMinGain_m2 = 0.03;
/// Utility grows with the gain to this power; at 0 only the travel time counts.
constexpr double kGainExponent = 0.6;
/// Share of the utility that is lost where the laser would not fix the pose.
constexpr double kLocalizabilityWeight = 0.3;
/// The present viewpoint is left only for one that is better by this share.
constexpr double kHysteresis = 0.25;
/// Speed, yaw rate and acceleration from which travel times are estimated.
constexpr double kSpeed_m_s = 0.8, kYawRate_rad_s = 1.0, kAcceleration_m_s2 = 0.8;

/// A frontier with the best place to see it from.
struct Option {
  std::size_t frontier = 0;
  Lookout lookout;
  View view;
  double utility = 0.0;
};

/// One call of exploreByUtility().
class Choice {
 public:
  Choice(const ExplorationInput& input, const ExplorerConfig& config)
      : input_(input),
        config_(config),
        survey_(input),
        map_(survey_.map()),
        scout_(map_, survey_.field(), config, input.bounds ? &*input.bounds : nullptr) {}

  ExplorationResult run() {
    if (survey_.shutIn()) return survey_.finish(std::nullopt, false);
    evaluate();
    reviewCurrent();
    if (options_.empty()) return survey_.finish(std::nullopt, false);
    const Option& best = greatestUtility();
    const bool keep = current_ && best.utility <= current_->utility * (1.0 + kHysteresis);
    return survey_.finish(viewpointOf(keep ? *current_ : best), keep);
  }

 private:
  /// Finds viewpoints for the open frontiers, the nearest first, until none that is farther away can be better.
  void evaluate() {
    for (const SeenFrontier& seen : survey_.seenBy(scout_)) {
      if (options_.size() >= kMaxEvaluated) break;
      if (!options_.empty() && greatestUtility().utility >= bound(seen.nearest_m)) break;
      double greatest_gain_m2 = 0.0;
      if (const auto best = bestOf(seen, greatest_gain_m2)) {
        survey_.score(seen.number, best->utility);
        options_.push_back(*best);
      } else {
        leaveUnseen(seen.number, greatest_gain_m2);
      }
    }
  }

  /// The best place to see a frontier from. Places from which no attempt was made come before all others.
  std::optional<Option> bestOf(const SeenFrontier& seen, double& greatest_gain_m2) const {
    std::optional<Option> best;
    bool best_is_new = false;
    for (const Lookout& lookout : seen.lookouts) {
      const Option option = optionAt(seen.number, lookout);
      greatest_gain_m2 = std::max(greatest_gain_m2, option.view.gain_m2);
      if (option.view.gain_m2 < kMinGain_m2) continue;
      const bool is_new = !survey_.lookedFrom(lookout);
      if (best && (is_new != best_is_new ? best_is_new : option.utility <= best->utility)) continue;
      best = option;
      best_is_new = is_new;
    }
    return best;
  }

  /// Closes a frontier of which no reachable place sees enough: as too small if even a view from the frontier itself
  /// sees too little, otherwise as unreachable.
  void leaveUnseen(std::size_t frontier, double greatest_gain_m2) {
    const std::vector<common::CellIndex>& cells = survey_.run(frontier).cells;
    const double at_it_m2 = scout_.view(cells[cells.size() / 2], 0.0).gain_m2;
    if (at_it_m2 < kMinGain_m2) {
      survey_.leave(frontier, FrontierReason::kTooSmall, fmt::format("{:.2f} m2 to be seen", greatest_gain_m2));
    } else {
      survey_.leave(frontier, FrontierReason::kUnreachable,
                    fmt::format("from where one can be at clearance {:.2f} m only {:.2f} of {:.2f} m2 are seen",
                                map_.footprint().clearance_m, greatest_gain_m2, at_it_m2));
    }
  }

  Option optionAt(std::size_t frontier, const Lookout& lookout) const {
    Option option{frontier, lookout, {}, 0.0};
    const Point towards_target_m = map_.centerOf(lookout.target) - map_.centerOf(lookout.place);
    option.view = scout_.view(lookout.place, std::atan2(towards_target_m.y(), towards_target_m.x()));
    const double trust = 1.0 - kLocalizabilityWeight * (1.0 - option.view.localizability);
    option.utility = trust * std::pow(option.view.gain_m2, kGainExponent) /
                     (travelTime_s(lookout.path_m, option.view.yaw_map_rad) + brake_s());
    return option;
  }

  /// The greatest utility that a viewpoint at least this far away can have: it sees the unknown at the end of its range
  /// in the whole field of view.
  double bound(double path_m) const {
    const double field_of_view_rad = config_.laser_field_of_view_deg * std::numbers::pi / 180.0;
    const double depth_m = Scout::kGainDepth_m + 2.0 * map_.resolution_m();
    const double free_m = std::max(0.0, config_.laser_range_m - depth_m);
    const double gain_m2 = 0.5 * field_of_view_rad * (config_.laser_range_m * config_.laser_range_m - free_m * free_m);
    return std::pow(gain_m2, kGainExponent) / (path_m / kSpeed_m_s + brake_s());
  }

  double brake_s() const { return kSpeed_m_s / kAcceleration_m_s2; }

  double travelTime_s(double path_m, double yaw_map_rad) const {
    const double turn_rad = std::abs(common::wrapAngle(yaw_map_rad - input_.pose_map.yaw_rad));
    return std::max(path_m / kSpeed_m_s, turn_rad / kYawRate_rad_s);
  }

  /// The current viewpoint stays an option while there is something left to see at its target.
  void reviewCurrent() {
    std::vector<std::size_t> numbers;
    for (const Option& option : options_) numbers.push_back(option.frontier);
    const std::optional<std::size_t> frontier = survey_.ofCurrent(numbers);
    if (!frontier) return;
    Option option = optionAt(*frontier, survey_.currentLookout());
    if (option.view.gain_m2 < kMinGain_m2) return;
    option.view.yaw_map_rad = input_.current->pose_map.yaw_rad;
    current_ = option;
  }

  const Option& greatestUtility() const {
    return *std::max_element(options_.begin(), options_.end(),
                             [](const Option& a, const Option& b) { return a.utility < b.utility; });
  }

  Viewpoint viewpointOf(const Option& option) const {
    const Point place_m = map_.centerOf(option.lookout.place);
    return {{place_m.x(), place_m.y(), option.view.yaw_map_rad},
            map_.centerOf(option.lookout.target),
            option.view.gain_m2,
            option.utility};
  }

  const ExplorationInput& input_;
  const ExplorerConfig& config_;
  FrontierSurvey survey_;
  const CostMap& map_;
  Scout scout_;
  std::vector<Option> options_;
  std::optional<Option> current_;
};

}  // namespace

ExplorationResult exploreByUtility(const ExplorationInput& input, const ExplorerConfig& config) {
  return Choice(input, config).run();
}

}  // namespace swiftlet::planning
