#include "autonomy/maneuvers/lowered_flight.hpp"

namespace swiftlet::autonomy {

void LoweredFlight::follow(const planning::Path* plan, const common::VehicleState& state) {
  // A flight back searches lowered places within a metre (Retrace), so with a tenth of that none is lost.
  constexpr double kSpacing_m = 0.1;
  if (!memory_.lowered_m) return;
  const bool planned = plan != nullptr && plan->anyLowered();
  if (controller_.state() != common::FlightState::kFlying || (!planned && dip_m() == 0.0)) {
    memory_.lowered_m.reset();
    return;
  }
  const Eigen::Vector2d here_map_m = state.T_map_body_planar().position_m();
  auto& places = memory_.lowered_map_m;
  if (dip_m() > 0.0 && (places.empty() || (places.back().head<2>() - here_map_m).norm() > kSpacing_m))
    places.emplace_back(here_map_m.x(), here_map_m.y(), *memory_.lowered_m);
}

double LoweredFlight::dip_m() const {
  constexpr double kBackUp_m = 0.02;  // A reference this near to the height of paths is back there.
  const FlightHeights now = heights();
  if (!now.lowered_m) return 0.0;
  const double dip_m = now.cruise_m - now.reference_m;
  return dip_m > kBackUp_m ? dip_m : 0.0;
}

}  // namespace swiftlet::autonomy
