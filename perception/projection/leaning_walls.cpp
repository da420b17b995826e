#include "perception/projection/leaning_walls.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace swiftlet::perception {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A plane is fitted anew after this many further ends; older ones count half each time there are so many.
constexpr float kRefit = 32.0F, kMany = 4096.0F;
/// Ends lie on a plane if they are off it by no more than the noise of a small laser and of the pose together.
constexpr double kPlane_m = 0.025;
/// A plane is known if its ends spread this far along and up it, and three times as far as off it.
constexpr double kSpread_m = 0.05, kSpreadShare = 3.0;
/// Less than 17 deg from upright: within the error of a lean that was seen over kSpread_m.
constexpr double kUpright = 0.3;
/// Flatter than 27 deg from the level it is a floor, a ramp or a ceiling, of which a section is no wall.
constexpr double kFlat = 2.0;
/// A wall goes on: this many cells around lean within so much of it, and turned by at most 25 deg. At the post of a
/// door, with a person in it, a cell alone seems to lean.
constexpr int kAlike = 2;
constexpr float kLeansAlike = 0.3F, kTurnedAlike = 0.9F;
/// An end farther off the plane is on something else.
constexpr double kOn_m = 0.1;
/// A plane is followed this far from where it was seen.
constexpr double kFollowed_m = 1.0;
/// An end this near to the height is there.
constexpr double kThere_m = 0.02;

}  // namespace

void LeaningWalls::fit(Cell& cell) {
  cell.added = 0.0F;
  const Eigen::Vector3d mean_m = (cell.sum_m / cell.count).cast<double>();
  const Eigen::Matrix3d covariance_m2 = (cell.squares_m2 / cell.count).cast<double>() - mean_m * mean_m.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance_m2);
  const Eigen::Array3d sigmas_m = solver.eigenvalues().array().max(0.0).sqrt();
  const Vector3d normal = solver.eigenvectors().col(0);
  const double level = normal.head<2>().norm();
  const bool spread = sigmas_m(1) >= std::max(kSpread_m, kSpreadShare * sigmas_m(0));
  if (sigmas_m(0) > kPlane_m) {
    cell.normal.setZero();
    cell.lean = 0.0F;
  } else if (spread) {  // What is seen from one height only says nothing new.
    const bool wall = std::abs(normal.z()) <= kFlat * level;
    const double lean = wall ? -normal.z() / level : 0.0;
    cell.normal = wall ? Eigen::Vector2f((normal.head<2>() / level).cast<float>()) : Eigen::Vector2f::Zero();
    cell.lean = std::abs(lean) >= kUpright ? static_cast<float>(lean) : 0.0F;
  }
  if (cell.count < kMany) return;
  cell.count *= 0.5F;
  cell.sum_m *= 0.5F;
  cell.squares_m2 *= 0.5F;
}

void LeaningWalls::judge(common::CellIndex index) {
  const Cell cell = cells_.at(index);
  int alike = 0;
  for (int y = index.y - 1; y <= index.y + 1; ++y)
    for (int x = index.x - 1; x <= index.x + 1; ++x) {
      const Cell other = cells_.at({x, y});
      const bool itself = x == index.x && y == index.y;
      if (!itself && other.lean != 0.0F &&
          cell.normal.dot(other.normal) * std::copysign(1.0F, cell.lean * other.lean) > kTurnedAlike &&
          std::abs(std::abs(cell.lean) - std::abs(other.lean)) <= kLeansAlike * std::abs(cell.lean))
        ++alike;
    }
  const bool wall = cell.lean != 0.0F && alike >= kAlike;
  if (wall == cell.wall) return;
  cells_.mutableAt(index).wall = wall;
  leaning_cells_ += wall ? 1 : -1;
}

void LeaningWalls::add(const ProjectedScan& scan, const common::Pose3& T_odom_body) {
  const common::Pose2 T_odom_level = common::planar(T_odom_body);
  const Eigen::Rotation2Dd turn(T_odom_level.yaw_rad);
  for (std::size_t i = 0; i < scan.points_level_m.size(); ++i) {
    if (!scan.moves.empty() && scan.moves[i]) continue;
    const Vector2d place = T_odom_level.position_m() + turn * scan.points_level_m[i].cast<double>();
    const common::CellIndex index = cells_.cellAt(place);
    Cell& cell = cells_.mutableAt(index);
    Eigen::Vector3f offset_m;
    offset_m.head<2>() = (place - cells_.centerOf(index)).cast<float>();
    offset_m.z() = static_cast<float>(T_odom_body.position_m.z()) + scan.heights_level_m[i];
    cell.count += 1.0F;
    cell.sum_m += offset_m;
    cell.squares_m2 += offset_m * offset_m.transpose();
    cell.added += 1.0F;
    if (cell.added < kRefit) continue;
    const float leaned = cell.lean;
    fit(cell);
    if (cell.lean == leaned) continue;
    for (int y = index.y - 1; y <= index.y + 1; ++y)
      for (int x = index.x - 1; x <= index.x + 1; ++x) judge({x, y});
  }
}

std::optional<Eigen::Vector2d> LeaningWalls::leanAt(const Vector3d& point_odom_m) const {
  const common::CellIndex at = cells_.cellAt(Vector2d(point_odom_m.head<2>()));
  double nearest_m = kOn_m;
  std::optional<Vector2d> lean;
  for (int y = at.y - 1; y <= at.y + 1; ++y) {
    for (int x = at.x - 1; x <= at.x + 1; ++x) {
      const Cell cell = cells_.at({x, y});
      if (cell.normal.isZero()) continue;
      const Vector2d normal = cell.normal.cast<double>();
      const Vector3d mean_m = (cell.sum_m / cell.count).cast<double>();
      const Vector2d off_m = point_odom_m.head<2>() - cells_.centerOf({x, y}) - mean_m.head<2>();
      const double beside_m =
          std::abs(normal.dot(off_m) - static_cast<double>(cell.lean) * (point_odom_m.z() - mean_m.z()));
      if (beside_m >= nearest_m) continue;
      nearest_m = beside_m;
      lean = (cell.wall ? static_cast<double>(cell.lean) : 0.0) * normal;
    }
  }
  return lean;
}

ProjectedScan LeaningWalls::moved(const ProjectedScan& scan, double height_odom_m, bool only_known,
                                  double& squares_m2) const {
  ProjectedScan result = scan;
  const common::Pose2 T_odom_level = common::planar(scan.T_odom_body);
  const Eigen::Rotation2Dd turn(T_odom_level.yaw_rad);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < scan.points_level_m.size(); ++i) {
    const double height_m = scan.T_odom_body.position_m.z() + static_cast<double>(scan.heights_level_m[i]);
    Vector2d point_level_m = scan.points_level_m[i].cast<double>();
    float height_level_m = scan.heights_level_m[i];
    if (std::abs(height_m - height_odom_m) > kThere_m) {
      const Vector2d place = T_odom_level.position_m() + turn * point_level_m;
      const std::optional<Vector2d> lean = leanAt({place.x(), place.y(), height_m});
      if (only_known && !lean) continue;
      const Vector2d moved_m = (height_odom_m - height_m) * lean.value_or(Vector2d::Zero());
      if (only_known && moved_m.norm() > kFollowed_m) continue;
      if (!moved_m.isZero()) height_level_m = static_cast<float>(height_odom_m - scan.T_odom_body.position_m.z());
      point_level_m += turn.inverse() * moved_m;
      squares_m2 += moved_m.squaredNorm();
    }
    result.points_level_m[kept] = point_level_m.cast<float>();
    result.heights_level_m[kept] = height_level_m;
    if (!scan.moves.empty()) result.moves[kept] = scan.moves[i];
    ++kept;
  }
  result.counts.hits -= static_cast<int>(scan.points_level_m.size() - kept);
  result.points_level_m.resize(kept);
  result.heights_level_m.resize(kept);
  if (!scan.moves.empty()) result.moves.resize(kept);
  return result;
}

ProjectedScan LeaningWalls::atHeight(const ProjectedScan& scan, double height_odom_m) const {
  double squares_m2 = 0.0;
  return any() ? moved(scan, height_odom_m, false, squares_m2) : scan;
}

LeaningWalls::Section LeaningWalls::sectionAt(const ProjectedScan& scan, double height_odom_m) const {
  if (!any()) return {scan};
  double squares_m2 = 0.0;
  Section section{moved(scan, height_odom_m, true, squares_m2)};
  const auto ends = static_cast<double>(std::max<std::size_t>(section.scan.points_level_m.size(), 1));
  section.moved_m = std::sqrt(squares_m2 / ends);
  return section;
}

}  // namespace swiftlet::perception
