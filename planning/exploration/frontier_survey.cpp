#include "planning/exploration/frontier_survey.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "common/check.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using common::Frontier;
using common::FrontierReason;
using Point = Eigen::Vector2d;

/// Shorter frontiers are left as too small.
constexpr double kMinFrontier_m = 0.30;
/// Longer frontiers are cut into pieces of at most this length.
constexpr double kSegment_m = 1.5;
/// Frontiers this near to a target during whose approach the position became uncertain are not explored
/// (docs/decisions/fail_safes.md#029).
constexpr double kLostRadius_m = 4.0;
/// A frontier that remains after this many views is not tried again (docs/decisions/planning.md#012).
constexpr int kMaxAttempts = 3;
/// Views from this near to a frontier count as attempts at it (docs/decisions/planning.md#012).
constexpr double kAttemptRadius_m = 0.35;

const CostMap& mapOf(const ExplorationInput& input) {
  SWIFTLET_CHECK(input.cost_map != nullptr);
  return *input.cost_map;
}

void setReason(Frontier& frontier, FrontierReason reason, const std::string& detail) {
  frontier.reason = reason;
  frontier.explanation = fmt::format("{}: {}", common::toString(reason), detail);
}

}  // namespace

FrontierSurvey::FrontierSurvey(const ExplorationInput& input)
    : input_(input), map_(mapOf(input)), runs_(findFrontiers(map_, kSegment_m)) {
  for (const FrontierRun& run : runs_) frontiers_.push_back(described(run));
  const std::optional<CellPath> escape = escapeFrom(map_, map_.cellAt(input.pose_map.position_m()));
  shut_in_ = !escape;
  if (escape) field_.spread(map_, escape->back());
}

/// The frontier of a run, with the reasons that depend on its place alone.
Frontier FrontierSurvey::described(const FrontierRun& run) const {
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
  if (run.run_length_m < kMinFrontier_m) {
    setReason(frontier, FrontierReason::kTooSmall, fmt::format("{:.2f} m long", run.run_length_m));
  } else if (!inside) {
    setReason(frontier, FrontierReason::kOutOfBounds, "outside the bounds of the mission");
  } else if (isLost(frontier.centroid_map_m)) {
    setReason(frontier, FrontierReason::kPositionUncertain,
              "the position became, or would become, uncertain during the approach");
  } else if (frontier.attempts >= kMaxAttempts) {
    setReason(frontier, FrontierReason::kBlacklisted, fmt::format("looked at {} times", frontier.attempts));
  }
  return frontier;
}

std::vector<SeenFrontier> FrontierSurvey::seenBy(const Scout& scout) {
  std::vector<SeenFrontier> seen;
  for (std::size_t i = 0; i < frontiers_.size(); ++i) {
    if (frontiers_[i].reason != FrontierReason::kOpen) continue;
    if (!input_.leave_building && !scout.hasWallsToMatch(runs_[i].cells[runs_[i].cells.size() / 2])) {
      leave(i, FrontierReason::kPositionUncertain, "too few walls around it to know the position there");
      continue;
    }
    SeenFrontier frontier{i, scout.lookouts(runs_[i]), std::numeric_limits<double>::infinity()};
    if (frontier.lookouts.empty()) {
      leave(i, FrontierReason::kUnreachable,
            fmt::format("no place that sees it can be reached at clearance {:.2f} m", map_.footprint().clearance_m));
      continue;
    }
    for (const Lookout& lookout : frontier.lookouts) frontier.nearest_m = std::min(frontier.nearest_m, lookout.path_m);
    seen.push_back(std::move(frontier));
  }
  std::stable_sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.nearest_m < b.nearest_m; });
  return seen;
}

void FrontierSurvey::leave(std::size_t number, FrontierReason reason, const std::string& detail) {
  setReason(frontiers_[number], reason, detail);
}

std::optional<std::size_t> FrontierSurvey::ofCurrent(const std::vector<std::size_t>& numbers) const {
  if (!input_.current) return std::nullopt;
  const CellIndex target = map_.cellAt(input_.current->target_map_m);
  const CellIndex place = map_.cellAt(input_.current->pose_map.position_m());
  if (!map_.rect().contains(place) || !field_.reached(map_.indexOf(place))) return std::nullopt;
  double nearest_m = kAttemptRadius_m;
  std::optional<std::size_t> nearest;
  for (const std::size_t number : numbers) {
    for (const CellIndex cell : runs_[number].cells) {
      const double distance_m = (map_.centerOf(cell) - map_.centerOf(target)).norm();
      if (distance_m > nearest_m) continue;
      nearest_m = distance_m;
      nearest = number;
    }
  }
  return nearest;
}

Lookout FrontierSurvey::currentLookout() const {
  const CellIndex place = map_.cellAt(input_.current->pose_map.position_m());
  return {place, map_.cellAt(input_.current->target_map_m), field_.cost_m(map_.indexOf(place), map_.resolution_m())};
}

bool FrontierSurvey::isAt(const ExplorationAttempt& attempt, const Point& target_map_m) const {
  return (attempt.target_map_m - target_map_m).norm() <= kAttemptRadius_m;
}

int FrontierSurvey::attemptsAt(const Point& target_map_m) const {
  return static_cast<int>(std::count_if(input_.attempts.begin(), input_.attempts.end(),
                                        [&](const auto& attempt) { return isAt(attempt, target_map_m); }));
}

bool FrontierSurvey::lookedFrom(const Lookout& lookout) const {
  const Point target_m = map_.centerOf(lookout.target), place_m = map_.centerOf(lookout.place);
  const double as_near_m = std::max(kAttemptRadius_m, 0.5 * (target_m - place_m).norm());
  return std::any_of(input_.attempts.begin(), input_.attempts.end(), [&](const auto& attempt) {
    return isAt(attempt, target_m) && (attempt.place_map_m - place_m).norm() <= as_near_m;
  });
}

bool FrontierSurvey::isLost(const Point& centroid_map_m) const {
  return std::any_of(input_.lost_map_m.begin(), input_.lost_map_m.end(),
                     [&](const Point& lost) { return (lost - centroid_map_m).norm() <= kLostRadius_m; });
}

double FrontierSurvey::freeArea_m2() const {
  const auto cells = std::count(map_.states().all().begin(), map_.states().all().end(), CellState::kFree);
  return static_cast<double>(cells) * map_.resolution_m() * map_.resolution_m();
}

ExplorationResult FrontierSurvey::finish(std::optional<Viewpoint> next, bool kept_current) {
  const auto open = std::count_if(frontiers_.begin(), frontiers_.end(),
                                  [](const Frontier& f) { return f.reason == FrontierReason::kOpen; });
  ExplorationResult result;
  result.explored_area_m2 = freeArea_m2();
  result.done = open == 0;
  result.next = std::move(next);
  result.kept_current = kept_current;
  if (result.next) {
    result.reason = fmt::format("{} open frontiers, next viewpoint {} for {:.1f} m2", open,
                                map_.names().of(result.next->pose_map.position_m()), result.next->gain_m2);
  } else if (shut_in_) {
    result.reason = fmt::format("the vehicle is shut in at clearance {:.2f} m", map_.footprint().clearance_m);
  } else {
    result.reason = fmt::format("{} frontiers left, each with a reason", frontiers_.size());
  }
  std::stable_sort(frontiers_.begin(), frontiers_.end(), [](const Frontier& a, const Frontier& b) {
    const bool a_open = a.reason == FrontierReason::kOpen, b_open = b.reason == FrontierReason::kOpen;
    return a_open != b_open ? a_open : a.score > b.score;
  });
  result.frontiers = std::move(frontiers_);
  return result;
}

}  // namespace swiftlet::planning
