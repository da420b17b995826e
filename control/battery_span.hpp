// The voltages that a battery has in flight.
#pragma once

#include "common/vehicle_config.hpp"

namespace swiftlet::control {

struct VoltageSpan {
  double low_v = 0.0;
  double high_v = 0.0;
};

/// From 0.9 times the empty battery, to which a load sags it, to the full one: what a table C(U) spans.
inline VoltageSpan batterySpan(const common::VehicleConfig& vehicle) {
  constexpr double kBelowEmpty = 0.9;
  return {kBelowEmpty * vehicle.battery_empty_v, vehicle.battery_full_v};
}

}  // namespace swiftlet::control
