#include "planning/costs/localizability.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace swiftlet::planning {
namespace {

/// A place around which a smaller share of the directions ends at walls is not explored, as outside an open door. One
/// endless wall, which fixes one direction only, is half of them (measured: docs/decisions/fail_safes.md#029).
constexpr double kLeastWallShare = 0.55;
/// Range within which walls count for it.
constexpr double kWallRange_m = 25.0;
/// A direction that is free as far as this without a wall counts as open (measured: docs/decisions/planning.md#088).
constexpr double kOpen_m = 5.0;

}  // namespace

Eigen::Vector2d wallNormal(const CostMap& map, int index) {
  // 5 x 5 cells: 25 cm of wall in the shipped map, which give a normal and do not reach round a corner.
  constexpr int kHalf = 2;
  const common::CellIndex center = map.cellOf(index);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  int count = 0;
  for (int dy = -kHalf; dy <= kHalf; ++dy) {
    for (int dx = -kHalf; dx <= kHalf; ++dx) {
      if (map.states().at({center.x + dx, center.y + dy}) != CellState::kOccupied) continue;
      const Eigen::Vector2d offset(dx, dy);
      sum += offset;
      squares += offset * offset.transpose();
      ++count;
    }
  }
  if (count < 3) return Eigen::Vector2d::Zero();
  const Eigen::Matrix2d covariance = squares / count - sum * sum.transpose() / (static_cast<double>(count) * count);
  const double a = covariance(0, 0), b = covariance(0, 1), d = covariance(1, 1);
  const double root = std::hypot(0.5 * (a - d), b);
  if (root < 0.2 * (a + d)) return Eigen::Vector2d::Zero();  // About as wide as long: a corner or a blob has no normal.
  const double along_rad = 0.5 * std::atan2(2.0 * b, a - d);
  return {-std::sin(along_rad), std::cos(along_rad)};
}

double localizability(const std::vector<WallReturn>& returns, int beams) {
  // Point-to-line alignment: each return has the Jacobian (n_x, n_y, n . (z x p)).
  Eigen::Matrix2d position = Eigen::Matrix2d::Zero();
  Eigen::Vector2d cross = Eigen::Vector2d::Zero();
  double yaw = 0.0, lever2_m2 = 0.0;
  for (const WallReturn& r : returns) {
    const double lever_m = r.offset_m.x() * r.normal.y() - r.offset_m.y() * r.normal.x();
    position += r.normal * r.normal.transpose();
    cross += r.normal * lever_m;
    yaw += lever_m * lever_m;
    lever2_m2 += r.offset_m.squaredNorm();
  }
  if (beams <= 0 || lever2_m2 <= 0.0) return 0.0;
  const double mean = 0.5 * position.trace();
  const double weakest = mean - std::hypot(0.5 * (position(0, 0) - position(1, 1)), position(0, 1));
  if (weakest < 1e-6 * beams) return 0.0;
  const double yaw_alone = yaw - cross.dot(position.inverse() * cross);
  // In the middle of a square room half of the beams fix each direction, and the yaw has about a sixth of the leverage.
  const double position_share = 2.0 * weakest / beams, yaw_share = 6.0 * yaw_alone / lever2_m2;
  return std::clamp(std::min(position_share, yaw_share), 0.0, 1.0);
}

double wallShareAt(const CostMap& map, common::CellIndex place, double range_m, double open_m,
                   const Directions& directions) {
  int walls = 0, open = 0;
  for (const Directions::Ray& ray : directions.rays()) {
    const double step_m = ray.step_cells * map.resolution_m();
    double free_m = 0.0;
    bool wall = false;
    castRay(map, place, ray, static_cast<int>(range_m / step_m), [&](int index, int step) {
      wall = map.states()[index] == CellState::kOccupied;
      if (map.states()[index] != CellState::kFree) return false;
      free_m = step * step_m;
      return true;
    });
    walls += wall ? 1 : 0;
    open += !wall && free_m >= open_m ? 1 : 0;
  }
  return walls + open > 0 ? static_cast<double>(walls) / (walls + open) : 1.0;
}

bool hasWallsToMatch(const CostMap& map, common::CellIndex place, const Directions& directions) {
  return wallShareAt(map, place, kWallRange_m, kOpen_m, directions) >= kLeastWallShare;
}

}  // namespace swiftlet::planning
