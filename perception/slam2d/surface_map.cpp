#include "perception/slam2d/surface_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "perception/slam2d/grid_ray.hpp"

namespace swiftlet::perception {
namespace {

using common::CellIndex;
using common::Pose2;
using common::occupancy::Cell;
namespace occupancy = common::occupancy;

constexpr std::uint8_t kViewCrossed = 1, kViewEnded = 2;
/// Offsets within a cell and components of unit normals are stored in signed bytes.
constexpr double kOffsetsPerCell = 254.0;
constexpr double kNormalLength = 127.0;
/// A mean normal shorter than this share of a unit normal is not clear: the normals of its hits differ as much as those
/// of two walls at a corner.
constexpr double kClearNormal = 0.75;

/// The mean updated by a value; `count` includes that value.
std::int8_t meanWith(std::int8_t mean, double value, int count) {
  const double moved = mean + (value - mean) / count;
  return static_cast<std::int8_t>(std::lround(std::clamp(moved, -127.0, 127.0)));
}

/// The share of a ray within the band. The ray starts at the body, at height `body_m` within the band, and ends
/// `height_m` above the body.
double withinBand(const DrawnHeights& band, double body_m, double height_m) {
  if (band.contains(body_m + height_m)) return 1.0;
  return (height_m > 0.0 ? band.high_m - body_m : band.low_m - body_m) / height_m;
}

}  // namespace

DrawnHeights heightsAround(double flight_height_m, const GridDrawingConfig& config) {
  return {flight_height_m - config.max_height_below_m, flight_height_m + config.max_height_above_m};
}

SurfaceScan toDraw(const ProjectedScan& scan, const GridDrawingConfig& config, const DrawnHeights& band) {
  SurfaceScan drawn;
  const double body_m = scan.T_odom_body.position_m.z(), max_hit_range_m = config.max_hit_range_m;
  if (!band.contains(body_m)) return drawn;
  const auto free = [&](const Eigen::Vector2f& end, double height_m, double range_m) -> Eigen::Vector2f {
    const float within_range = static_cast<float>(range_m) / std::max(end.norm(), 1e-6F);
    return end * std::min(static_cast<float>(withinBand(band, body_m, height_m)), within_range);
  };
  const std::vector<OrientedPoint> oriented = orientedPoints(scan, 0, SurfaceMap::kMaxGap_m, max_hit_range_m);
  auto next = oriented.begin();
  for (std::size_t i = 0; i < scan.points_level_m.size(); ++i) {
    const Eigen::Vector2f& end = scan.points_level_m[i];
    if (!end.allFinite()) continue;
    const double height_m = i < scan.heights_level_m.size() ? static_cast<double>(scan.heights_level_m[i]) : 0.0;
    const bool is_oriented = next != oriented.end() && next->point_m == end;
    const SurfaceScan::Hit hit =
        is_oriented ? SurfaceScan::Hit{next->foot_m, next->normal} : SurfaceScan::Hit{end, Eigen::Vector2f::Zero()};
    if (is_oriented) ++next;
    if (end.norm() > static_cast<float>(max_hit_range_m) || !band.contains(body_m + height_m))
      drawn.free_m.push_back(free(end, height_m, max_hit_range_m));
    else
      drawn.hits.push_back(hit);
  }
  for (const Eigen::Vector3f& end : scan.misses_level_m)
    if (end.allFinite())
      drawn.free_m.push_back(free(end.head<2>(), static_cast<double>(end.z()), config.max_free_range_m));
  for (const Eigen::Vector3f& end : scan.no_returns_level_m)
    if (end.allFinite())
      drawn.no_returns_m.push_back(free(end.head<2>(), static_cast<double>(end.z()), config.max_free_range_m));
  return drawn;
}

SurfaceMap SurfaceMap::snapshot() {
  SurfaceMap copy(config_);
  copy.grid_ = grid_.snapshot();
  return copy;
}

common::OccupancyGrid SurfaceMap::occupancy() const {
  common::OccupancyGrid occupancy = common::makeOccupancyGrid(config_.resolution_m);
  grid_.forEachCell([&](CellIndex index, const SurfaceCell& cell) {
    if (!occupancy::isUnknown(cell.log_odds)) occupancy.set(index, cell.log_odds);
  });
  return occupancy;
}

std::vector<ContourSegment> SurfaceMap::contourAround(const Eigen::Vector2d& middle_m, double half_m) const {
  std::vector<ContourSegment> contour;
  const Eigen::Vector2d half(half_m, half_m);
  const CellIndex low = cellAt(middle_m - half), high = cellAt(middle_m + half);
  const common::CellRect around{low, {high.x + 1, high.y + 1}};
  grid_.forEachCell([&](CellIndex index, const SurfaceCell& cell) {
    if (!cell.isOccupied() || !around.contains(index)) return;
    const Eigen::Vector2d at_m = surface_m(index, cell), normal(cell.normal_x, cell.normal_y);
    Eigen::Vector2d arm_m = Eigen::Vector2d::Zero();
    if (normal.norm() > kClearNormal * kNormalLength) {
      const Eigen::Vector2d along = normal.unitOrthogonal();
      arm_m = 0.5 * config_.resolution_m / along.cwiseAbs().maxCoeff() * along;
    }
    contour.push_back({at_m - arm_m, at_m + arm_m});
  });
  return contour;
}

/// Marks the cells that beams cross and the cells that they end in. A cell where beams do both is marked as an end.
void SurfaceMap::sketch(const SurfaceScan& scan, const Pose2& T_map_body, DrawingBoard& board) const {
  const double scale = 1.0 / config_.resolution_m;
  const Eigen::Vector2d body = scale * T_map_body.position_m();
  const Eigen::Matrix2d R = scale * Eigen::Rotation2Dd(T_map_body.yaw_rad).toRotationMatrix();
  const auto inCells = [&](const Eigen::Vector2f& p) -> Eigen::Vector2d { return body + R * p.cast<double>(); };
  const CellIndex first = cellOf(body);
  common::CellRect rect{first, {first.x + 1, first.y + 1}};
  const auto include = [&](const Eigen::Vector2f& p) {
    const CellIndex c = cellOf(inCells(p));
    rect.begin = {std::min(rect.begin.x, c.x), std::min(rect.begin.y, c.y)};
    rect.end = {std::max(rect.end.x, c.x + 1), std::max(rect.end.y, c.y + 1)};
  };
  for (const SurfaceScan::Hit& hit : scan.hits) include(hit.point_m);
  for (const Eigen::Vector2f& end : scan.free_m) include(end);
  for (const Eigen::Vector2f& end : scan.no_returns_m) include(end);

  board.rect = rect;
  board.marks.assign(static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height()), 0);
  const auto markAt = [&](CellIndex c) -> std::uint8_t& {
    return board.marks[static_cast<std::size_t>(c.y - rect.begin.y) * static_cast<std::size_t>(rect.width()) +
                       static_cast<std::size_t>(c.x - rect.begin.x)];
  };
  const auto cross = [&](const Eigen::Vector2d& to) {
    visitCrossed(body, to, [&](const CellIndex& cell, double, double) {
      markAt(cell) |= kViewCrossed;
      return true;
    });
  };
  for (const SurfaceScan::Hit& hit : scan.hits) {
    const Eigen::Vector2d to = inCells(hit.point_m);
    cross(to);
    markAt(cellOf(to)) = kViewEnded;
  }
  for (const Eigen::Vector2f& end : scan.free_m) cross(inCells(end));
  // A wall that is dark, or hit at a grazing angle, returns no beam: nothing is known behind it.
  const auto isWall = [&](const CellIndex& cell) {
    return (markAt(cell) & kViewEnded) != 0 || grid_.at(cell).isOccupied();
  };
  for (const Eigen::Vector2f& end : scan.no_returns_m) cross(beforeWall(body, inCells(end), isWall));
}

/// Adds to the log-odds of a cell. An unchanged cell is not written, so that its tile stays shared.
void SurfaceMap::update(CellIndex index, int steps) {
  const SurfaceCell old = grid_.at(index);
  const int sum = (occupancy::isUnknown(old.log_odds) ? 0 : old.log_odds) + steps;
  const auto value = static_cast<Cell>(std::clamp(sum, -config_.max_steps, config_.max_steps));
  if (value == old.log_odds) return;
  SurfaceCell& cell = grid_.mutableAt(index);
  cell.log_odds = value;
  if (!cell.isOccupied()) cell.hits = 0;  // The surface that was here is gone.
}

void SurfaceMap::forget(CellIndex index) {
  if (!grid_.at(index).isOccupied()) return;
  SurfaceCell& cell = grid_.mutableAt(index);
  cell.log_odds = 0;
  cell.hits = 0;
}

void SurfaceMap::addSurface(const Eigen::Vector2d& point_m, const Eigen::Vector2d& normal) {
  const CellIndex index = grid_.cellAt(point_m);
  SurfaceCell& cell = grid_.mutableAt(index);
  if (cell.hits < kMaxHits) ++cell.hits;
  const Eigen::Vector2d offset = (point_m - grid_.centerOf(index)) * (kOffsetsPerCell / config_.resolution_m);
  cell.offset_x = meanWith(cell.offset_x, offset.x(), cell.hits);
  cell.offset_y = meanWith(cell.offset_y, offset.y(), cell.hits);
  cell.normal_x = meanWith(cell.normal_x, kNormalLength * normal.x(), cell.hits);
  cell.normal_y = meanWith(cell.normal_y, kNormalLength * normal.y(), cell.hits);
}

void SurfaceMap::draw(const SurfaceScan& scan, const Pose2& T_map_body, DrawingBoard& board) {
  sketch(scan, T_map_body, board);
  const std::uint8_t* mark = board.marks.data();
  for (int y = board.rect.begin.y; y < board.rect.end.y; ++y) {
    for (int x = board.rect.begin.x; x < board.rect.end.x; ++x, ++mark) {
      if (*mark == 0) continue;
      update({x, y}, (*mark & kViewEnded) != 0 ? config_.hit_steps : -config_.free_steps);
    }
  }
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(T_map_body.yaw_rad).toRotationMatrix();
  for (const SurfaceScan::Hit& hit : scan.hits) {
    const Eigen::Vector2d point_m = T_map_body.position_m() + R * hit.point_m.cast<double>();
    if (grid_.at(grid_.cellAt(point_m)).isOccupied()) addSurface(point_m, R * hit.normal.cast<double>());
  }
}

}  // namespace swiftlet::perception
