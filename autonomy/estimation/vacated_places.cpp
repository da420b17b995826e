#include "autonomy/estimation/vacated_places.hpp"

#include <algorithm>
#include <cmath>

#include "perception/slam2d/grid_ray.hpp"

namespace swiftlet::autonomy {
namespace {

using common::CellIndex;
using common::Time;

constexpr double kPeriod_s = 0.045;  ///< Scans in between are left out: twenty a second suffice.
constexpr double kReach_m = 4.0;     ///< What blocks a path is near.
constexpr double kHover_m_s = 0.2;   ///< Above the speed of a hover in gusts; flights are faster.
/// Beams that rise or fall by more than this show nothing at the laser's height.
constexpr double kLevel_m = 0.04;
constexpr int kHits = 5;                                     ///< Fewer may be noise.
constexpr double kPassed_s = 0.35;                           ///< Longer than the gap between two legs stays open.
constexpr int kPasses = 4;                                   ///< So that no single wrong scan frees a place.
constexpr double kForgotten_s = 90.0, kForgetEvery_s = 1.0;  ///< Bounds the memory; longer than people block a path.

template <typename Cells>
void sortOnce(Cells& cells) {
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

}  // namespace

bool VacatedPlaces::Met::vacated() const {
  return hits >= kHits && passed_since && passes >= kPasses && (passed_last - *passed_since).seconds() >= kPassed_s;
}

bool VacatedPlaces::update(const perception::ProjectedScan& scan, const common::Pose2& T_map_body,
                           const common::OccupancyGrid& grid) {
  if (last_ && (scan.stamp - *last_).seconds() < kPeriod_s) return false;
  const bool still = hovers(scan, T_map_body);
  last_ = scan.stamp;
  last_pose_ = T_map_body;
  forget(scan.stamp);
  const Beams beams = levelBeams(scan, T_map_body, grid, still);
  const bool vacated = pass(beams, scan.stamp);
  return meet(beams, scan.stamp) || vacated;
}

void VacatedPlaces::forget(Time now) {
  if (forgot_ && (now - *forgot_).seconds() < kForgetEvery_s) return;
  forgot_ = now;
  std::erase_if(met_, [&](const auto& entry) {
    const bool old = (now - entry.second.seen).seconds() > kForgotten_s;
    if (old) vacated_.erase(entry.first);
    return old;
  });
}

bool VacatedPlaces::hovers(const perception::ProjectedScan& scan, const common::Pose2& T_map_body) {
  if (!last_) return false;
  const double dt_s = (scan.stamp - *last_).seconds();
  return dt_s > 0.0 && (T_map_body.position_m() - last_pose_.position_m()).norm() < kHover_m_s * dt_s;
}

VacatedPlaces::Beams VacatedPlaces::levelBeams(const perception::ProjectedScan& scan, const common::Pose2& T_map_body,
                                               const common::OccupancyGrid& grid, bool hovers) const {
  Beams beams;
  const double cell_m = grid.resolution_m();
  const Eigen::Vector2d from_m = T_map_body.position_m();
  for (std::size_t i = 0; i < scan.points_level_m.size(); ++i) {
    const float height_m = i < scan.heights_level_m.size() ? scan.heights_level_m[i] : 0.0F;
    if (!scan.points_level_m[i].allFinite()) continue;
    const Eigen::Vector2d beam_m = T_map_body * Eigen::Vector2d(scan.points_level_m[i].cast<double>()) - from_m;
    const double range_m = beam_m.norm(), share = std::min(1.0, kReach_m / std::max(range_m, 1e-9));
    const double rise_m = height_m - scan.laser_height_level_m;
    if (!(std::abs(rise_m) * share < kLevel_m)) continue;
    const Eigen::Vector2d end = (from_m + share * beam_m) / cell_m;
    if (share >= 1.0) {
      const CellIndex last = perception::cellOf(end);
      beams.ended.emplace_back(last.x, last.y);
    }
    if (!hovers) continue;
    perception::visitCrossed(from_m / cell_m, end, [&](const CellIndex& cell, double, double) {
      if (common::occupancy::isOccupied(grid.at(cell))) beams.passed.emplace_back(cell.x, cell.y);
      return true;
    });
  }
  sortOnce(beams.ended);
  sortOnce(beams.passed);
  return beams;
}

/// Noise in range makes beams pass the outer cells of a wall now and then, but beams end beside these.
bool VacatedPlaces::pass(const Beams& beams, Time now) {
  const auto endsNear = [&](const Cell& cell) {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (std::binary_search(beams.ended.begin(), beams.ended.end(), Cell(cell.first + dx, cell.second + dy)))
          return true;
    return false;
  };
  bool changed = false;
  for (const Cell& cell : beams.passed) {
    const auto found = met_.find(cell);
    if (found == met_.end()) continue;
    Met& met = found->second;
    if (endsNear(cell)) {
      changed = vacated_.erase(cell) > 0 || changed;
      met.passed_since.reset();
      met.passes = 0;
      continue;
    }
    if (!met.passed_since) met.passed_since = now;
    ++met.passes;
    met.seen = met.passed_last = now;
    if (met.vacated()) changed = vacated_.insert(cell).second || changed;
  }
  return changed;
}

/// From other distances and tilts the same outline is drawn into the cells beside.
bool VacatedPlaces::meet(const Beams& beams, Time now) {
  bool changed = false;
  for (const Cell& cell : beams.ended) {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        Met& met = met_[{cell.first + dx, cell.second + dy}];
        met.hits = std::min(met.hits + 1, kHits);
        met.seen = now;
        if (dx != 0 || dy != 0) continue;
        changed = vacated_.erase(cell) > 0 || changed;
        met.passed_since.reset();
        met.passes = 0;
      }
  }
  return changed;
}

void VacatedPlaces::clear(common::OccupancyGrid& grid, const std::function<bool(CellIndex)>& is_kept) const {
  for (const auto& [x, y] : vacated_)
    if (common::occupancy::isOccupied(grid.at({x, y})) && !is_kept({x, y})) grid.set({x, y}, 0);
}

}  // namespace swiftlet::autonomy
