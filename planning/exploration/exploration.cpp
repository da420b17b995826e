#include "planning/exploration/exploration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/check.hpp"
#include "planning/exploration/frontiers.hpp"
#include "planning/exploration/viewpoints.hpp"
#include "planning/search/wavefront.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using common::Frontier;
using common::FrontierReason;
using Point = Eigen::Vector2d;

/// A frontier with the best place to see it from.
struct Option {
  std::size_t frontier = 0;
  Lookout lookout;
  View view;
  double time_s = 0.0;
  double utility = 0.0;
};

class Explorer {
 public:
  Explorer(const ExplorationInput& input, const ExplorationConfig& config)
      : input_(input), config_(config), map_(*input.cost_map) {}

  ExplorationResult run() {
    ExplorationResult result;
    result.explored_area_m2 = freeArea();
    runs_ = findFrontiers(map_, config_.segment_m);
    for (const FrontierRun& run : runs_) frontiers_.push_back(described(run));

    const std::optional<CellPath> escape = escapeFrom(map_, map_.cellAt(input_.pose_map.position_m()));
    if (!escape) {
      result.reason = fmt::format("the vehicle is shut in at clearance {:.2f} m", map_.footprint().clearance_m);
    } else {
      escape_ = *escape;
      field_.spread(map_, escape_.back());
      evaluate();
      choose(result);
    }
    finish(result);
    return result;
  }

 private:
  double freeArea() const {
    const auto cells = std::count(map_.states().begin(), map_.states().end(), CellState::kFree);
    return static_cast<double>(cells) * map_.resolution_m() * map_.resolution_m();
  }

  /// The frontier with the reasons that can be told from its place alone.
  Frontier described(const FrontierRun& run) const {
    Frontier frontier;
    frontier.cells = run.cells;
    frontier.length_m = static_cast<double>(run.cells.size()) * map_.resolution_m();
    bool inside = false;
    for (const CellIndex cell : run.cells) {
      const Point center_m = map_.centerOf(cell);
      frontier.centroid_map_m += center_m / static_cast<double>(run.cells.size());
      inside |= !input_.bounds || input_.bounds->contains(center_m);
      frontier.attempts = std::max(frontier.attempts, attemptsAt(center_m));
    }
    if (run.run_length_m < config_.min_frontier_m) {
      leave(frontier, FrontierReason::kTooSmall, fmt::format("{:.2f} m long", run.run_length_m));
    } else if (!inside) {
      leave(frontier, FrontierReason::kOutOfBounds, "outside the bounds of the mission");
    } else if (frontier.attempts >= config_.max_attempts) {
      leave(frontier, FrontierReason::kBlacklisted, fmt::format("looked at {} times", frontier.attempts));
    }
    return frontier;
  }

  bool isAt(const ExplorationAttempt& attempt, const Point& target_m) const {
    return (attempt.target_map_m - target_m).norm() <= config_.attempt_radius_m;
  }

  int attemptsAt(const Point& target_m) const {
    return static_cast<int>(std::count_if(input_.attempts.begin(), input_.attempts.end(),
                                          [&](const auto& attempt) { return isAt(attempt, target_m); }));
  }

  /// Whether one looked from about there already: another look promises more from elsewhere.
  bool lookedFrom(const Lookout& lookout) const {
    const Point target_m = map_.centerOf(lookout.target), place_m = map_.centerOf(lookout.place);
    const double as_near_m = std::max(config_.attempt_radius_m, 0.5 * (target_m - place_m).norm());
    return std::any_of(input_.attempts.begin(), input_.attempts.end(), [&](const auto& attempt) {
      return isAt(attempt, target_m) && (attempt.place_map_m - place_m).norm() <= as_near_m;
    });
  }

  static void leave(Frontier& frontier, FrontierReason reason, const std::string& detail) {
    frontier.reason = reason;
    frontier.explanation = fmt::format("{}: {}", common::toString(reason), detail);
  }

  /// Looks for viewpoints of the open frontiers, the nearest first.
  void evaluate() {
    const Scout scout(map_, field_, config_);
    std::vector<std::pair<double, std::size_t>> order;
    std::vector<std::vector<Lookout>> lookouts(frontiers_.size());
    for (std::size_t i = 0; i < frontiers_.size(); ++i) {
      if (frontiers_[i].reason != FrontierReason::kOpen) continue;
      lookouts[i] = scout.lookouts(runs_[i]);
      if (lookouts[i].empty()) {
        leave(frontiers_[i], FrontierReason::kUnreachable,
              fmt::format("no place that sees it can be reached at clearance {:.2f} m", map_.footprint().clearance_m));
        continue;
      }
      double nearest_m = std::numeric_limits<double>::infinity();
      for (const Lookout& lookout : lookouts[i]) nearest_m = std::min(nearest_m, lookout.path_m);
      order.push_back({nearest_m, i});
    }
    std::sort(order.begin(), order.end());
    for (const auto& [path_m, i] : order) {
      if (static_cast<int>(options_.size()) >= config_.max_evaluated) break;
      std::optional<Option> best;
      bool best_is_new = false;
      double greatest_gain_m2 = 0.0;
      for (const Lookout& lookout : lookouts[i]) {
        const Option option = optionAt(scout, i, lookout);
        greatest_gain_m2 = std::max(greatest_gain_m2, option.view.gain_m2);
        if (option.view.gain_m2 < config_.min_gain_m2) continue;
        const bool is_new = !lookedFrom(lookout);
        if (best && (is_new != best_is_new ? best_is_new : option.utility <= best->utility)) continue;
        best = option;
        best_is_new = is_new;
      }
      if (best) {
        frontiers_[i].score = best->utility;
        options_.push_back(*best);
      } else {
        leaveUnseen(i, scout.view(middleOf(i), 0.0).gain_m2, greatest_gain_m2);
      }
    }
    if (input_.current) reviewCurrent(scout);
  }

  CellIndex middleOf(std::size_t frontier) const {
    const std::vector<CellIndex>& cells = runs_[frontier].cells;
    return cells[cells.size() / 2];
  }

  /// None of the places that can be reached sees enough of it.
  void leaveUnseen(std::size_t frontier, double at_it_m2, double greatest_gain_m2) {
    if (at_it_m2 < config_.min_gain_m2) {
      leave(frontiers_[frontier], FrontierReason::kTooSmall, fmt::format("{:.2f} m2 to be seen", greatest_gain_m2));
    } else {
      leave(frontiers_[frontier], FrontierReason::kUnreachable,
            fmt::format("from where one can be at clearance {:.2f} m only {:.2f} of {:.2f} m2 are seen",
                        map_.footprint().clearance_m, greatest_gain_m2, at_it_m2));
    }
  }

  Option optionAt(const Scout& scout, std::size_t frontier, const Lookout& lookout) const {
    Option option{frontier, lookout, {}, 0.0, 0.0};
    const Point travel_m = map_.centerOf(lookout.target) - map_.centerOf(lookout.place);
    option.view = scout.view(lookout.place, std::atan2(travel_m.y(), travel_m.x()));
    option.time_s = travelTime(lookout.path_m, option.view.yaw_map_rad);
    const double trust = 1.0 - config_.localizability_weight * (1.0 - option.view.localizability);
    const double exponent = config_.strategy == ExplorationStrategy::kNearest ? 0.0 : config_.gain_exponent;
    option.utility = trust * std::pow(option.view.gain_m2, exponent) /
                     (option.time_s + config_.speed_m_s / config_.acceleration_m_s2);
    return option;
  }

  double travelTime(double path_m, double yaw_map_rad) const {
    const double turn_rad = std::abs(common::wrapAngle(yaw_map_rad - input_.pose_map.yaw_rad));
    return std::max(path_m / config_.speed_m_s, turn_rad / config_.yaw_rate_rad_s);
  }

  /// The viewpoint being flown to stays an option while there is something left to see at its target.
  void reviewCurrent(const Scout& scout) {
    const CellIndex target = map_.cellAt(input_.current->target_map_m);
    const CellIndex place = map_.cellAt(input_.current->pose_map.position_m());
    if (!map_.contains(place) || !field_.reached(map_.indexOf(place))) return;
    double nearest_m = config_.attempt_radius_m;
    std::optional<std::size_t> frontier;
    for (const Option& option : options_) {
      for (const CellIndex cell : runs_[option.frontier].cells) {
        const double distance_m = (map_.centerOf(cell) - map_.centerOf(target)).norm();
        if (distance_m > nearest_m) continue;
        nearest_m = distance_m;
        frontier = option.frontier;
      }
    }
    if (!frontier) return;
    const Lookout lookout{place, target, field_.cost_m(map_.indexOf(place), map_.resolution_m())};
    Option option = optionAt(scout, *frontier, lookout);
    if (option.view.gain_m2 < config_.min_gain_m2) return;
    option.view.yaw_map_rad = input_.current->pose_map.yaw_rad;
    current_ = option;
  }

  void choose(ExplorationResult& result) {
    if (options_.empty()) return;
    const Option* best = greatestUtility();
    if (current_ && best->utility <= current_->utility * (1.0 + config_.hysteresis)) {
      best = &*current_;
      result.kept_current = true;
    }
    const Point target_m = map_.centerOf(best->lookout.target);
    const Point place_m = map_.centerOf(best->lookout.place);
    CellPath cells = escape_;
    const CellPath rest = field_.pathTo(map_, best->lookout.place);
    cells.insert(cells.end(), rest.begin() + 1, rest.end());
    Path path = shortened(map_, cells, escape_.size() - 1, input_.pose_map.position_m(), place_m);
    result.next = Viewpoint{{place_m.x(), place_m.y(), best->view.yaw_map_rad},
                            std::move(path),
                            target_m,
                            best->view.gain_m2,
                            best->utility};
  }

  const Option* greatestUtility() const {
    return &*std::max_element(options_.begin(), options_.end(),
                              [](const Option& a, const Option& b) { return a.utility < b.utility; });
  }

  void finish(ExplorationResult& result) {
    const auto open = std::count_if(frontiers_.begin(), frontiers_.end(),
                                    [](const Frontier& f) { return f.reason == FrontierReason::kOpen; });
    result.done = open == 0;
    if (result.next) {
      result.reason = fmt::format("{} open frontiers, next viewpoint {:.1f} m away for {:.1f} m2", open,
                                  result.next->path.length_m, result.next->gain_m2);
    } else if (result.reason.empty()) {
      result.reason = fmt::format("{} frontiers left, each with a reason", frontiers_.size());
    }
    std::stable_sort(frontiers_.begin(), frontiers_.end(), [](const Frontier& a, const Frontier& b) {
      const bool a_open = a.reason == FrontierReason::kOpen, b_open = b.reason == FrontierReason::kOpen;
      return a_open != b_open ? a_open : a.score > b.score;
    });
    result.frontiers = std::move(frontiers_);
  }

  const ExplorationInput& input_;
  const ExplorationConfig& config_;
  const CostMap& map_;
  std::vector<FrontierRun> runs_;
  std::vector<Frontier> frontiers_;
  CellPath escape_;
  CostField field_;
  std::vector<Option> options_;
  std::optional<Option> current_;
};

}  // namespace

ExplorationResult explore(const ExplorationInput& input, const ExplorationConfig& config) {
  SWIFTLET_CHECK(input.cost_map != nullptr);
  return Explorer(input, config).run();
}

}  // namespace swiftlet::planning
