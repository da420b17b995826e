#include "perception/altitude/fan_ground.hpp"

#include <cmath>
#include <cstddef>

#include "perception/altitude/ground_cell.hpp"
#include "perception/altitude/ground_limits.hpp"

namespace swiftlet::perception {
namespace {

/// Older points of a cell are left out: the error of attitude and position stays the same for about this long.
constexpr double kTogether_s = 3.0;
/// Nearer hits are obstacles, also on ground: below 27 cm over a slope of 15 degrees.
constexpr double kObstacle_m = 1.0;
/// A plane that lies higher above the ground below the vehicle does not go on from it. The gradients of cells are wrong
/// by up to a tenth, 3 m away.
constexpr double kAboveGround_m = 0.3;
/// From farther away a gradient does not tell that.
constexpr double kFanRange_m = kAboveGround_m / kGradientSigma;
/// An end point is on a slope if it is this near to its plane.
constexpr double kOnPlane_m = kSigmas * kPlane_m;

Eigen::Vector3d pointOdom_m(const ProjectedScan& scan, std::size_t i, const common::Pose2& T_odom_body,
                            double height_m) {
  const Eigen::Vector2d place_odom_m = T_odom_body * Eigen::Vector2d(scan.points_level_m[i].cast<double>());
  return {place_odom_m.x(), place_odom_m.y(), height_m + static_cast<double>(scan.heights_level_m[i])};
}

}  // namespace

void FanGround::add(const ProjectedScan& scan, const common::Pose2& T_odom_body, double height_m,
                    double surface_height_m) {
  for (std::size_t i = 0; i < scan.points_level_m.size(); ++i) {
    if (!scan.moves.empty() && scan.moves[i]) continue;
    const float range_m = scan.points_level_m[i].norm();
    if (range_m > kFanRange_m || range_m < kObstacle_m) continue;
    const Eigen::Vector3d point_m = pointOdom_m(scan, i, T_odom_body, height_m);
    const common::CellIndex index = cellAt(point_m.head<2>(), kSlopeCell_m);
    Cell& cell = cells_[index];
    if (cell.plane.points() == 0 || (scan.stamp - cell.since).seconds() > kTogether_s) cell = {scan.stamp, {}};
    cell.plane.add(point_m);
    const auto gradient = cell.plane.gradient();
    if (!gradient || gradient->norm() < kLeastGradient) continue;
    const Slope slope{cell.plane, *gradient};
    if (slope.height_m(T_odom_body.position_m()) < surface_height_m + kAboveGround_m) slopes_[index] = slope;
  }
}

/// A ramp is wider than one cell, while the end points on branches and rocks may lie on a plane in a single one.
bool FanGround::isGround(const Eigen::Vector3d& point_odom_m) const {
  const common::CellIndex center = cellAt(point_odom_m.head<2>(), kSlopeCell_m);
  int planes = 0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const auto found = slopes_.find({center.x + dx, center.y + dy});
      if (found == slopes_.end()) continue;
      const Slope& slope = found->second;
      if (std::abs(point_odom_m.z() - slope.height_m(point_odom_m.head<2>())) < kOnPlane_m) ++planes;
    }
  return planes >= kAgreeing;
}

void FanGround::remove(ProjectedScan& scan) const {
  if (slopes_.empty()) return;
  const common::Pose2 T_odom_body = common::planar(scan.T_odom_body);
  const double height_m = scan.T_odom_body.position_m.z();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < scan.points_level_m.size(); ++i) {
    const Eigen::Vector2f& point_m = scan.points_level_m[i];
    if (point_m.norm() > static_cast<float>(kObstacle_m) && isGround(pointOdom_m(scan, i, T_odom_body, height_m))) {
      scan.misses_level_m.push_back({point_m.x(), point_m.y(), scan.heights_level_m[i]});
      --scan.counts.hits;
      ++scan.counts.floor_hits;
      continue;
    }
    scan.points_level_m[kept] = point_m;
    scan.heights_level_m[kept++] = scan.heights_level_m[i];
  }
  scan.points_level_m.resize(kept);
  scan.heights_level_m.resize(kept);
}

}  // namespace swiftlet::perception
