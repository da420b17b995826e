#include "simulation/start_surroundings.hpp"

#include <cmath>
#include <numbers>

namespace swiftlet::simulation {

const Shape* terrainAbove(const WorldModel& world, const RayCaster& rays, const Eigen::Vector3d& point_world_m) {
  constexpr int kMostSurfaces = 32;
  constexpr double kStepThrough_m = 1e-3;
  Eigen::Vector3d from = point_world_m;
  for (int surface = 0; surface < kMostSurfaces; ++surface) {
    const Hit hit = rays.cast(from, Eigen::Vector3d::UnitZ(), 1e4);
    if (!hit) return nullptr;
    const Shape& shape = world.shapes[static_cast<std::size_t>(hit.shape)];
    if (shape.terrain) return &shape;
    from.z() += hit.distance_m + kStepThrough_m;
  }
  return nullptr;
}

StartSurroundings::StartSurroundings(const RayCaster& rays, const Hull& hull, const Eigen::Vector3d& start_world_m,
                                     double flight_height_m)
    : rays_(rays),
      hull_(hull),
      start_world_m_(start_world_m),
      flight_height_m_(flight_height_m),
      blocking_(rays.sweep(hull, start_world_m, start_world_m, 0.01).shape) {}

int StartSurroundings::drawbacksOf(const Eigen::Vector3d& place_world_m) const {
  const Eigen::Vector3d flying = place_world_m + flight_height_m_ * Eigen::Vector3d::UnitZ();
  const bool roomy = rays_.sweep(hull_, flying, flying, hull_.radius_m).shape == Hit::kNothing;
  return (seesStart(flying) ? 0 : 4) + (isEnclosed(flying) ? 0 : 2) + (roomy ? 0 : 1);
}

/// The start itself may be in a wall, which both of its sides see.
bool StartSurroundings::seesStart(const Eigen::Vector3d& flying_world_m) const {
  Eigen::Vector3d to_start_m = start_world_m_ - flying_world_m;
  to_start_m.z() = 0.0;
  const double length_m = to_start_m.norm();
  if (length_m <= hull_.radius_m) return true;
  const Hit hit = rays_.cast(flying_world_m, to_start_m / length_m, length_m - hull_.radius_m);
  return !hit || hit.shape == blocking_;
}

bool StartSurroundings::isEnclosed(const Eigen::Vector3d& flying_world_m) const {
  constexpr int kRays = 40, kLeastHits = 32;  // A room has doors.
  constexpr double kFarthest_m = 60.0;
  int hits = 0;
  for (int i = 0; i < kRays; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * (i + 0.5) / kRays;
    hits += rays_.cast(flying_world_m, {std::cos(angle_rad), std::sin(angle_rad), 0.0}, kFarthest_m) ? 1 : 0;
  }
  return hits >= kLeastHits;
}

}  // namespace swiftlet::simulation
