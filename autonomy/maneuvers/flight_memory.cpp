#include "autonomy/maneuvers/flight_memory.hpp"

#include <cmath>

namespace swiftlet::autonomy {

FlightHeights heightsOf(const FlightMemory& memory, const control::FlightController& controller) {
  return {memory.cruise_height_m, controller.follower().reference().position_odom_m.z(), controller.maxHeight_m(),
          memory.in_space};
}

double dip_m(const FlightMemory& memory, const control::FlightController& controller) {
  constexpr double kBack_m = 0.02;  // A reference this near to the height of paths is back there.
  const FlightHeights now = heightsOf(memory, controller);
  if (!now.in_space) return 0.0;
  const double lower_by_m = now.cruise_m - now.reference_m;
  return std::abs(lower_by_m) > kBack_m ? lower_by_m : 0.0;
}

void rememberHeights(FlightMemory& memory, const planning::Path* plan, const control::FlightController& controller,
                     const common::VehicleState& state) {
  // A flight back searches such places within a metre (Retrace), so with a tenth of that none is lost.
  constexpr double kSpacing_m = 0.1;
  if (!memory.in_space) return;
  const bool planned = plan != nullptr && plan->isInSpace();
  const FlightHeights heights = heightsOf(memory, controller);
  if (controller.state() != common::FlightState::kFlying || (!planned && dip_m(memory, controller) == 0.0)) {
    memory.in_space = false;
    return;
  }
  const Eigen::Vector2d here_map_m = state.T_map_body_planar().position_m();
  const Eigen::Vector3d place_map_m(here_map_m.x(), here_map_m.y(), heights.reference_m);
  auto& places = memory.other_heights_map_m;
  if (heights.isOff() && (places.empty() || (places.back() - place_map_m).norm() > kSpacing_m))
    places.push_back(place_map_m);
}

}  // namespace swiftlet::autonomy
