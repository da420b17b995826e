#include "planning/search/plan_keeper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/segment.hpp"

namespace swiftlet::planning {
namespace {

using Point = Eigen::Vector2d;

/// An older plan is compared with a new one (Grzonka 2012, section IV-E: every 500 ms).
constexpr double kMaxAge_s = 0.5;
/// A new plan replaces a valid one when it is cheaper by this share.
constexpr double kBetterBy = 0.10;
/// A plan does not hold any longer when the vehicle is farther from it than this and its braking distance.
constexpr double kMaxDeviation_m = 0.30;

}  // namespace

void PlanKeeper::clear() {
  path_.reset();
  valid_ = false;
}

PlanKeeper::Check PlanKeeper::check(common::Time now, const PlanMaps& maps, const Point& position_map_m,
                                    double braking_m) {
  if (!path_) return {false, true, "no plan"};
  advanceTo(position_map_m);
  const double deviation_m = (position_map_m - remaining().front()).norm();
  Check result{true, (now - stamp_).seconds() >= kMaxAge_s, ""};
  if (const Rest left = rest(maps); left.blocked_map_m) {
    result = {false, true, "blocked before " + maps.costs.names().of(*left.blocked_map_m)};
  } else if (deviation_m > kMaxDeviation_m + braking_m) {
    result = {false, true, fmt::format("{:.2f} m off the plan", deviation_m)};
  }
  valid_ = result.valid;
  return result;
}

bool PlanKeeper::offer(const Path& path, common::Time now, const PlanMaps& maps, const Point& position_map_m) {
  if (path_ && valid_ && path.points_map_m.back() == path_->points_map_m.back()) {
    advanceTo(position_map_m);
    stamp_ = now;
    const Rest old = rest(maps);
    if (!old.blocked_map_m && path.cost_m >= old.cost_m * (1.0 - kBetterBy)) return false;
  }
  path_ = path;
  stamp_ = now;
  segment_ = 0;
  along_ = 0.0;
  valid_ = true;
  advanceTo(position_map_m);
  return true;
}

void PlanKeeper::advanceTo(const Point& position_map_m) {
  const std::vector<Point>& points = path_->points_map_m;
  // At a corner the later segment is chosen.
  constexpr double kSame_m = 1e-9;
  // Searches forwards only, and stops where the path leads away from the vehicle: a later part may come close again.
  double best_m = std::numeric_limits<double>::infinity();
  std::size_t best_segment = segment_;
  double best_along = along_;
  for (std::size_t i = segment_; i + 1 < points.size(); ++i) {
    double share = common::shareNearest(position_map_m, points[i], points[i + 1]);
    if (i == segment_) share = std::max(share, along_);
    const double off_m = (points[i] + share * (points[i + 1] - points[i]) - position_map_m).norm();
    if (off_m <= best_m + kSame_m) {
      best_m = std::min(best_m, off_m);
      best_segment = i;
      best_along = share;
    } else if (off_m > best_m + kMaxDeviation_m) {
      break;
    }
  }
  segment_ = best_segment;
  along_ = best_along;
}

/// It may begin in the lethal zone, which the vehicle must leave, and the lines of its escape may lead through it;
/// after that, a lethal line blocks it. A lowered line is judged at its height, and the others of such a plan by what
/// both sensors know at the height of flight.
PlanKeeper::Rest PlanKeeper::rest(const PlanMaps& maps) const {
  const std::vector<Point> points_m = remaining();
  const std::size_t escape_points = remainingEscape();
  const bool two = !path_->lowered.empty() && maps.heights != nullptr;
  const auto mapOf = [&](std::size_t line) -> const CostMap& {
    if (!two) return maps.costs;
    return path_->isLowered(segment_ + line) ? maps.heights->lower : maps.heights->upper;
  };
  Rest rest;
  bool leaving = isLethalAt(mapOf(0), points_m.front());
  for (std::size_t i = 1; i < points_m.size(); ++i) {
    const CostMap& map = mapOf(i - 1);
    const SegmentCost step = segmentCost(map, points_m[i - 1], points_m[i]);
    if (!step.lethal) {
      leaving = false;
      rest.cost_m += step.cost_m;
      continue;
    }
    const bool out = !isLethalAt(map, points_m[i]);
    if (!leaving && i > escape_points) {
      rest.blocked_map_m = points_m[i];
      return rest;
    }
    leaving = !out;
    rest.cost_m += (points_m[i] - points_m[i - 1]).norm();
  }
  if (leaving && points_m.size() > 1) rest.blocked_map_m = points_m.back();
  return rest;
}

std::size_t PlanKeeper::remainingEscape() const {
  return path_->escape_points - std::min(path_->escape_points, segment_);
}

std::vector<Point> PlanKeeper::remaining() const {
  if (!path_) return {};
  const std::vector<Point>& points = path_->points_map_m;
  if (points.size() == 1) return points;
  std::vector<Point> rest{points[segment_] + along_ * (points[segment_ + 1] - points[segment_])};
  rest.insert(rest.end(), points.begin() + static_cast<std::ptrdiff_t>(segment_) + 1, points.end());
  return rest;
}

}  // namespace swiftlet::planning
