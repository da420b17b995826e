#include "perception/slam2d/seen_through.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "perception/scan_matching/scan_contour.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

constexpr int kBins = 360;
/// Of one scan; more of them say the same.
constexpr int kPoints = 180;
/// Walls are rough and poses err; the farther away, the more.
constexpr double kBehind_m = 0.3;
constexpr double kBehindShare = 0.02;

std::size_t binOf(double angle_rad) {
  const auto bin = static_cast<int>(std::floor((angle_rad + std::numbers::pi) * (kBins / (2.0 * std::numbers::pi))));
  return static_cast<std::size_t>(std::clamp(bin, 0, kBins - 1));
}

/// Where the beams of each degree and of its neighbours end, so that a wall seen at an angle is not looked through.
struct View {
  Pose2 T_body_map;
  std::array<float, kBins> nearest_m, farthest_m;  ///< Infinite and 0 where no beam ended.
};

View viewOf(const PlacedScan& placed) {
  std::array<float, kBins> nearest_m, farthest_m;
  nearest_m.fill(std::numeric_limits<float>::infinity());
  farthest_m.fill(0.0F);
  for (const Eigen::Vector2f& p : placed.scan->points_level_m) {
    const std::size_t bin = binOf(std::atan2(p.y(), p.x()));
    nearest_m[bin] = std::min(nearest_m[bin], p.norm());
    farthest_m[bin] = std::max(farthest_m[bin], p.norm());
  }
  View view{placed.T_map_body.inverse(), {}, {}};
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    const std::size_t before = (bin + kBins - 1) % kBins, after = (bin + 1) % kBins;
    view.nearest_m[bin] = std::min({nearest_m[before], nearest_m[bin], nearest_m[after]});
    view.farthest_m[bin] = std::max({farthest_m[before], farthest_m[bin], farthest_m[after]});
  }
  return view;
}

struct Counts {
  int looked_at = 0, through = 0;
};

/// Adds the points of a scan that the views looked at.
void count(const std::vector<View>& views, const PlacedScan& placed, double max_range_m, Counts& counts) {
  const std::vector<Eigen::Vector2f> points = spreadPoints(placed.scan->points_level_m, kPoints, max_range_m);
  std::vector<char> looked_at(points.size(), 0), through(points.size(), 0);
  for (const View& view : views) {
    const Pose2 T_view_scan = view.T_body_map * placed.T_map_body;
    const Eigen::Rotation2Dd turn(T_view_scan.yaw_rad);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector2d there_m = turn * points[i].cast<double>() + T_view_scan.position_m();
      const std::size_t bin = binOf(std::atan2(there_m.y(), there_m.x()));
      const double range_m = there_m.norm();
      const double nearest_m = view.nearest_m[bin], farthest_m = view.farthest_m[bin];
      if (farthest_m <= 0.0 || range_m > farthest_m + kBehind_m) continue;
      looked_at[i] = 1;
      if (range_m < nearest_m - kBehind_m - kBehindShare * range_m) through[i] = 1;
    }
  }
  counts.looked_at += static_cast<int>(std::count(looked_at.begin(), looked_at.end(), 1));
  counts.through += static_cast<int>(std::count(through.begin(), through.end(), 1));
}

}  // namespace

double shareSeenThrough(std::span<const PlacedScan> one, std::span<const PlacedScan> other, double max_range_m) {
  Counts counts;
  for (const auto& [seeing, seen] : {std::pair{one, other}, std::pair{other, one}}) {
    std::vector<View> views;
    for (const PlacedScan& placed : seeing) views.push_back(viewOf(placed));
    for (const PlacedScan& placed : seen) count(views, placed, max_range_m, counts);
  }
  return counts.looked_at > 0 ? static_cast<double>(counts.through) / counts.looked_at : 0.0;
}

}  // namespace swiftlet::perception
