#include "perception/slam2d/particle/particle_map.hpp"

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

constexpr std::uint8_t kCrossed = 1, kEnded = 2;
constexpr double kOffsetsPerCell = 254.0;
constexpr double kNormalLength = 127.0;

/// Of the values before, `count` counting the new one.
std::int8_t meanWith(std::int8_t mean, double value, int count) {
  const double moved = mean + (value - mean) / count;
  return static_cast<std::int8_t>(std::lround(std::clamp(moved, -127.0, 127.0)));
}

}  // namespace

ParticleScan toDraw(const ProjectedScan& scan, const ParticleMapConfig& config) {
  ParticleScan drawn;
  const auto within = [](const Eigen::Vector2f& end, double range_m) -> Eigen::Vector2f {
    return end * std::min(1.0F, static_cast<float>(range_m) / std::max(end.norm(), 1e-6F));
  };
  const std::vector<OrientedPoint> oriented = orientedPoints(scan, 0, config.max_gap_m, config.max_hit_range_m);
  auto next = oriented.begin();
  for (const Eigen::Vector2f& end : scan.points_level_m) {
    if (!end.allFinite()) continue;
    if (end.norm() > static_cast<float>(config.max_hit_range_m)) {
      drawn.free_m.push_back(within(end, config.max_hit_range_m));
    } else if (next != oriented.end() && next->point_m == end) {
      drawn.hits.push_back({next->foot_m, next->normal});
      ++next;
    } else {
      drawn.hits.push_back({end, Eigen::Vector2f::Zero()});
    }
  }
  for (const Eigen::Vector3f& end : scan.misses_level_m)
    if (end.allFinite()) drawn.free_m.push_back(within(end.head<2>(), config.max_free_range_m));
  for (const Eigen::Vector3f& end : scan.no_returns_level_m)
    if (end.allFinite()) drawn.no_returns_m.push_back(within(end.head<2>(), config.max_free_range_m));
  return drawn;
}

ParticleMap ParticleMap::snapshot() {
  ParticleMap copy(config_);
  copy.grid_ = grid_.snapshot();
  return copy;
}

common::OccupancyGrid ParticleMap::occupancy() const {
  common::OccupancyGrid occupancy = common::makeOccupancyGrid(config_.resolution_m);
  grid_.forEachCell([&](CellIndex index, const ParticleCell& cell) {
    if (!occupancy::isUnknown(cell.log_odds)) occupancy.set(index, cell.log_odds);
  });
  return occupancy;
}

/// Marks the cells that the views cross and those they end in; where some do either, the end wins.
void ParticleMap::sketch(const ParticleScan& scan, const Pose2& T_map_body, DrawingBoard& board) const {
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
  for (const ParticleScan::Hit& hit : scan.hits) include(hit.point_m);
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
      markAt(cell) |= kCrossed;
      return true;
    });
  };
  for (const ParticleScan::Hit& hit : scan.hits) {
    const Eigen::Vector2d to = inCells(hit.point_m);
    cross(to);
    markAt(cellOf(to)) = kEnded;
  }
  for (const Eigen::Vector2f& end : scan.free_m) cross(inCells(end));
  // A wall that is dark, or seen at a grazing angle, swallows beams: nobody has looked through it.
  const auto isWall = [&](const CellIndex& cell) {
    return (markAt(cell) & kEnded) != 0 || grid_.at(cell).isOccupied();
  };
  for (const Eigen::Vector2f& end : scan.no_returns_m) cross(beforeWall(body, inCells(end), isWall));
}

/// Not writing what does not change leaves the tile shared.
void ParticleMap::update(CellIndex index, int steps) {
  const ParticleCell old = grid_.at(index);
  const int sum = (occupancy::isUnknown(old.log_odds) ? 0 : old.log_odds) + steps;
  const auto value = static_cast<Cell>(std::clamp(sum, -config_.max_steps, config_.max_steps));
  if (value == old.log_odds) return;
  ParticleCell& cell = grid_.mutableAt(index);
  cell.log_odds = value;
  if (!cell.isOccupied()) cell.hits = 0;  // The surface that was here is gone.
}

void ParticleMap::addSurface(const Eigen::Vector2d& point_m, const Eigen::Vector2d& normal) {
  const CellIndex index = grid_.cellAt(point_m);
  ParticleCell& cell = grid_.mutableAt(index);
  if (cell.hits < config_.max_hits) ++cell.hits;
  const Eigen::Vector2d offset = (point_m - grid_.centerOf(index)) * (kOffsetsPerCell / config_.resolution_m);
  cell.offset_x = meanWith(cell.offset_x, offset.x(), cell.hits);
  cell.offset_y = meanWith(cell.offset_y, offset.y(), cell.hits);
  cell.normal_x = meanWith(cell.normal_x, kNormalLength * normal.x(), cell.hits);
  cell.normal_y = meanWith(cell.normal_y, kNormalLength * normal.y(), cell.hits);
}

void ParticleMap::draw(const ParticleScan& scan, const Pose2& T_map_body, DrawingBoard& board) {
  sketch(scan, T_map_body, board);
  const std::uint8_t* mark = board.marks.data();
  for (int y = board.rect.begin.y; y < board.rect.end.y; ++y) {
    for (int x = board.rect.begin.x; x < board.rect.end.x; ++x, ++mark) {
      if (*mark == 0) continue;
      update({x, y}, (*mark & kEnded) != 0 ? config_.hit_steps : -config_.free_steps);
    }
  }
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(T_map_body.yaw_rad).toRotationMatrix();
  for (const ParticleScan::Hit& hit : scan.hits) {
    const Eigen::Vector2d point_m = T_map_body.position_m() + R * hit.point_m.cast<double>();
    if (grid_.at(grid_.cellAt(point_m)).isOccupied()) addSurface(point_m, R * hit.normal.cast<double>());
  }
}

}  // namespace swiftlet::perception
