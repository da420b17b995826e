#include "autonomy/maneuvers/flight_memory.hpp"

namespace swiftlet::autonomy {

FlightHeights heightsOf(const FlightMemory& memory, const control::FlightController& controller) {
  return {memory.cruise_height_m, controller.follower().reference().position_odom_m.z(), memory.lowered_m};
}

double dip_m(const FlightMemory& memory, const control::FlightController& controller) {
  constexpr double kBackUp_m = 0.02;  // A reference this near to the height of paths is back there.
  const FlightHeights now = heightsOf(memory, controller);
  if (!now.lowered_m) return 0.0;
  const double lower_by_m = now.cruise_m - now.reference_m;
  return lower_by_m > kBackUp_m ? lower_by_m : 0.0;
}

void rememberLowered(FlightMemory& memory, const planning::Path* plan, const control::FlightController& controller,
                     const common::VehicleState& state) {
  // A flight back searches lowered places within a metre (Retrace), so with a tenth of that none is lost.
  constexpr double kSpacing_m = 0.1;
  if (!memory.lowered_m) return;
  const bool planned = plan != nullptr && plan->anyLowered();
  const double lower_by_m = dip_m(memory, controller);
  if (controller.state() != common::FlightState::kFlying || (!planned && lower_by_m == 0.0)) {
    memory.lowered_m.reset();
    return;
  }
  const Eigen::Vector2d here_map_m = state.T_map_body_planar().position_m();
  auto& places = memory.lowered_map_m;
  if (lower_by_m > 0.0 && (places.empty() || (places.back().head<2>() - here_map_m).norm() > kSpacing_m))
    places.emplace_back(here_map_m.x(), here_map_m.y(), *memory.lowered_m);
}

}  // namespace swiftlet::autonomy
