#include "perception/slam2d/free_space_violation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "perception/scan_matching/scan_contour.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

/// Number of points that are sampled from one scan; more of them add no information.
constexpr int kPoints = 180;
/// A beam has crossed a point when it ends this far behind it. The margin covers rough walls and pose errors, and grows
/// with the range.
constexpr double kBehind_m = 0.3;
constexpr double kBehindShare = 0.02;
/// A direction was observed when beams end within this angle on both sides of it. At the edge of the field of view it
/// was not.
constexpr float kAside_rad = 1.5F * static_cast<float>(common::kRadPerDeg);

struct Beam {
  float angle_rad;
  float range_m;
};

struct View {
  Pose2 T_body_map;
  std::vector<Beam> beams;  ///< Sorted by angle; those near +-pi are listed at both ends.
};

View viewOf(const PlacedScan& placed) {
  constexpr float kHalfTurn_rad = std::numbers::pi_v<float>;
  View view{placed.T_map_body.inverse(), {}};
  for (const Eigen::Vector2f& p : placed.scan->points_level_m) {
    const Beam beam{std::atan2(p.y(), p.x()), p.norm()};
    view.beams.push_back(beam);
    if (std::abs(beam.angle_rad) > kHalfTurn_rad - kAside_rad)
      view.beams.push_back({beam.angle_rad - std::copysign(2.0F * kHalfTurn_rad, beam.angle_rad), beam.range_m});
  }
  std::sort(view.beams.begin(), view.beams.end(),
            [](const Beam& a, const Beam& b) { return a.angle_rad < b.angle_rad; });
  return view;
}

/// Range of the ends of the beams beside a direction.
struct Ends {
  float nearest_m, farthest_m;
};

/// Nothing when the direction was not observed.
std::optional<Ends> endsBeside(const View& view, float angle_rad) {
  const auto first = std::lower_bound(view.beams.begin(), view.beams.end(), angle_rad - kAside_rad,
                                      [](const Beam& beam, float angle) { return beam.angle_rad < angle; });
  Ends ends{std::numeric_limits<float>::infinity(), 0.0F};
  bool left = false, right = false;
  for (auto beam = first; beam != view.beams.end() && beam->angle_rad <= angle_rad + kAside_rad; ++beam) {
    ends = {std::min(ends.nearest_m, beam->range_m), std::max(ends.farthest_m, beam->range_m)};
    left |= beam->angle_rad >= angle_rad;
    right |= beam->angle_rad <= angle_rad;
  }
  return left && right ? std::optional(ends) : std::nullopt;
}

/// Counts the points of a scan that the views observed, and those that lie in free space of a view.
void count(const std::vector<View>& views, const PlacedScan& placed, double max_range_m, FreeSpaceEvidence& counts) {
  const std::vector<Eigen::Vector2f> points = spreadPoints(placed.scan->points_level_m, kPoints, max_range_m);
  std::vector<char> observed(points.size(), 0), crossed(points.size(), 0);
  for (const View& view : views) {
    const Pose2 T_view_scan = view.T_body_map * placed.T_map_body;
    const Eigen::Rotation2Dd turn(T_view_scan.yaw_rad);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector2d there_m = turn * points[i].cast<double>() + T_view_scan.position_m();
      const std::optional<Ends> ends = endsBeside(view, static_cast<float>(std::atan2(there_m.y(), there_m.x())));
      const double range_m = there_m.norm();
      if (!ends || range_m > ends->farthest_m + kBehind_m) continue;
      observed[i] = 1;
      if (range_m < ends->nearest_m - kBehind_m - kBehindShare * range_m) crossed[i] = 1;
    }
  }
  counts.points += static_cast<int>(points.size());
  counts.observed += static_cast<int>(std::count(observed.begin(), observed.end(), 1));
  counts.crossed += static_cast<int>(std::count(crossed.begin(), crossed.end(), 1));
}

}  // namespace

FreeSpaceEvidence freeSpaceEvidence(std::span<const PlacedScan> one, std::span<const PlacedScan> other,
                                    double max_range_m) {
  FreeSpaceEvidence counts;
  for (const auto& [seeing, seen] : {std::pair{one, other}, std::pair{other, one}}) {
    std::vector<View> views;
    for (const PlacedScan& placed : seeing) views.push_back(viewOf(placed));
    for (const PlacedScan& placed : seen) count(views, placed, max_range_m, counts);
  }
  return counts;
}

double freeSpaceViolation(std::span<const PlacedScan> one, std::span<const PlacedScan> other, double max_range_m) {
  return freeSpaceEvidence(one, other, max_range_m).violation();
}

}  // namespace swiftlet::perception
