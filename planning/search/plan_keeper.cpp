#include "planning/search/plan_keeper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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
    if (!old.blocked_map_m) {
      if (path.cost_m >= old.cost_m * (1.0 - kBetterBy)) return false;
      if (isLeftSoonBy(path)) {
        if (left_ && (now - *left_).seconds() < kSteady_s) return false;
        left_ = now;
      }
    }
  }
  path_ = path;
  stamp_ = now;
  segment_ = 0;
  along_ = 0.0;
  valid_ = true;
  advanceTo(position_map_m);
  return true;
}

/// Whether the first kSoon_m of a new plan lead elsewhere than the rest of the present one.
bool PlanKeeper::isLeftSoonBy(const Path& path) const {
  // Two plans of one way differ by a cell or two; and as far as the vehicle may be off its plan, each begins elsewhere.
  constexpr double kElsewhere_m = 0.2, kStep_m = 0.1;
  const std::vector<Point> old = remaining();
  const auto off_m = [&](const Point& point) {
    double least_m = (point - old.front()).norm();
    for (std::size_t i = 1; i < old.size(); ++i)
      least_m = std::min(least_m, common::segmentDistance(point, old[i - 1], old[i]));
    return least_m;
  };
  const double allowed_m = std::max(kElsewhere_m, off_m(path.points_map_m.front()));
  double along_m = 0.0;
  for (std::size_t i = 1; i < path.points_map_m.size() && along_m < kSoon_m; ++i) {
    const Point step = path.points_map_m[i] - path.points_map_m[i - 1];
    const double length_m = step.norm(), until_m = std::min(length_m, kSoon_m - along_m);
    for (double at_m = 0.0; at_m <= until_m; at_m += kStep_m)
      if (off_m(path.points_map_m[i - 1] + (length_m > 0.0 ? at_m / length_m : 0.0) * step) > allowed_m) return true;
    along_m += length_m;
  }
  return false;
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
/// after that, a lethal line blocks it.
PlanKeeper::Rest PlanKeeper::rest(const PlanMaps& maps) const {
  if (path_->isInSpace() && maps.space != nullptr) return restInSpace(maps);
  const std::vector<Point> points_m = remaining();
  const std::size_t escape_points = remainingEscape();
  const CostMap& map = maps.costs;
  Rest rest;
  bool leaving = isLethalAt(map, points_m.front());
  for (std::size_t i = 1; i < points_m.size(); ++i) {
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

/// The cost of the rest is its share of the length. It may begin where the hull is not free, and leave that. A plan
/// through a gap is kept with half a voxel less than it was made with: the edge of a gap comes and goes by a voxel.
PlanKeeper::Rest PlanKeeper::restInSpace(const PlanMaps& maps) const {
  const HullSpace& space = *maps.space;
  const double radius_m = space.radius_m - 0.5 * space.clearance.resolution_m();
  const auto isFree = [&](const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m) {
    return space.clearance.isFree(space.middleOf(from_m), space.middleOf(to_m), radius_m);
  };
  const std::vector<Point> points_m = remaining();
  const auto heightOf = [&](std::size_t point) {
    if (point > 0) return path_->heights_m[segment_ + point];
    const double from_m = path_->heights_m[segment_];
    return points_m.size() == 1 ? from_m : from_m + along_ * (path_->heights_m[segment_ + 1] - from_m);
  };
  const auto placeOf = [&](std::size_t point) {
    return Eigen::Vector3d(points_m[point].x(), points_m[point].y(), heightOf(point));
  };
  Rest rest;
  bool leaving = !isFree(placeOf(0), placeOf(0));
  double length_m = 0.0;
  for (std::size_t i = 1; i < points_m.size(); ++i) {
    const Eigen::Vector3d from = placeOf(i - 1), to = placeOf(i);
    length_m += (to - from).norm();
    const bool may_leave = std::exchange(leaving, false) || i <= remainingEscape();
    if (may_leave ? isFree(to, to) : isFree(from, to)) continue;
    rest.blocked_map_m = points_m[i];
    return rest;
  }
  rest.cost_m = path_->length_m > 0.0 ? path_->cost_m * length_m / path_->length_m : 0.0;
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
