#include "evaluation/map_metrics.hpp"

#include <algorithm>

#include "common/quantile.hpp"

namespace swiftlet::evaluation {

double coverage(const common::OccupancyGrid& map, const common::Pose2& T_world_map,
                const simulation::FreeSpace& free_space) {
  const common::Pose2 T_map_world = T_world_map.inverse();
  std::size_t all = 0, known = 0;
  free_space.covered.forEachCell([&](common::CellIndex cell, std::uint8_t covered) {
    if (covered == 0) return;
    ++all;
    const Eigen::Vector2d center_map_m = T_map_world * free_space.covered.centerOf(cell);
    if (!common::occupancy::isUnknown(map.at(map.cellAt(center_map_m)))) ++known;
  });
  return all == 0 ? 1.0 : static_cast<double>(known) / static_cast<double>(all);
}

std::optional<WallError> wallError(const common::OccupancyGrid& map, const common::Pose2& T_world_map,
                                   const simulation::RayCaster& rays, double height_world_m,
                                   std::span<const simulation::Actor> closed_doors) {
  std::vector<double> distances_m;
  map.forEachCell([&](common::CellIndex cell, common::occupancy::Cell value) {
    if (common::occupancy::isUnknown(value) || !common::occupancy::isOccupied(value)) return;
    const Eigen::Vector2d center_world_m = T_world_map * map.centerOf(cell);
    double distance_m = distanceToSurface2d(rays, center_world_m, height_world_m, WallError::kLimit_m);
    for (const simulation::Actor& door : closed_doors)
      distance_m =
          std::min(distance_m, gapTo_m(door, {0.0, 0.0}, {center_world_m.x(), center_world_m.y(), height_world_m}));
    distances_m.push_back(std::min(WallError::kLimit_m, distance_m));
  });
  if (distances_m.empty()) return std::nullopt;
  return WallError{common::quantile(distances_m, 0.5), common::quantile(distances_m, 0.95),
                   *std::max_element(distances_m.begin(), distances_m.end()), distances_m.size()};
}

}  // namespace swiftlet::evaluation
