// What the commander wants flown.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "autonomy/feedback.hpp"
#include "common/intent.hpp"

namespace swiftlet::autonomy {

/// What is to be flown. Between the ticks of the behaviours it stays.
struct Decision {
  common::Intent intent;
  std::string take_off_refusal;                              ///< Why the vehicle must not take off; empty if it may.
  double max_height_m = 0.0;                                 ///< Over the take-off floor.
  double spare_s = std::numeric_limits<double>::infinity();  ///< ManeuverInput::spare_s.
  bool mission_over = false;                                 ///< The vehicle lands, and stays on the ground.
  bool pilot_flies = false;                                  ///< Setpoints have no effect, or only assist the pilot.
  bool unseen = false;                                       ///< No sensor sees the surroundings.
  std::vector<GivenMapOrder> given_map;                      ///< Of this tick.
};

}  // namespace swiftlet::autonomy
