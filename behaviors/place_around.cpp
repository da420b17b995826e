#include "behaviors/place_around.hpp"

#include <cmath>
#include <numbers>

#include "common/geometry.hpp"
#include "common/line_of_sight.hpp"
#include "common/world.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {

std::optional<common::GoToIntent> nearestPlaceAround(const FlightTick& tick, const PlacesAround& around,
                                                     const common::GoToIntent& asked,
                                                     const std::function<bool(double bearing_rad)>& wanted) {
  const common::World& world = *tick.flight.world;
  const Eigen::Vector2d here_map_m = world.vehicle->state.T_map_body_planar().position_m();
  const auto& map = tick.flight.goal_map;
  std::optional<common::GoToIntent> nearest;
  for (int i = 0; i < around.count; ++i) {
    const double bearing_rad = 2.0 * std::numbers::pi * i / around.count;
    if (wanted && !wanted(bearing_rad)) continue;
    const Eigen::Vector2d place_map_m =
        around.middle_map_m + around.distance_m * Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
    if (map && map->stateAt(place_map_m, asked.clearance_m) != common::PlaceState::kFree) continue;
    if (!common::isInSight(*world.map->grid, place_map_m, around.middle_map_m, around.own_m)) continue;
    if (nearest && (place_map_m - here_map_m).norm() >= (nearest->goal_map_m - here_map_m).norm()) continue;
    nearest = asked;
    nearest->goal_map_m = place_map_m;
    nearest->yaw_map_rad = common::wrapAngle(bearing_rad + std::numbers::pi);
  }
  return nearest;
}

}  // namespace swiftlet::behaviors
