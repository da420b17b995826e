#include "autonomy/maneuvers/land.hpp"

namespace swiftlet::autonomy {

Land::Land(const common::LandIntent&, const ManeuverSetup& setup) : controller_(setup.controller) {
  if (control::isAirborne(controller_.state())) commanded_ = controller_.command(control::Land{});
}

Progress Land::step(const ManeuverInput&) {
  if (!commanded_) return Progress::failed(commanded_.error());
  return control::isAirborne(controller_.state()) ? Progress::running() : Progress::done("on the ground");
}

}  // namespace swiftlet::autonomy
