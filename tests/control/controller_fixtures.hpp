// What the tests of the controllers share: the model that an exact identification of the data sheet would give.
#pragma once

#include <string>

#include "common/gravity.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::control {

inline VehicleModel sheetModel() {
  const common::VehicleConfig sheet;
  VehicleModel model;
  model.version = VehicleModel::kVersion;
  model.vehicle = sheet.name;
  model.battery_full_v = sheet.battery_full_v;
  model.battery_empty_v = sheet.battery_empty_v;
  model.battery_capacity_ah = sheet.battery_capacity_ah;
  model.forward.gain = common::kGravity_m_s2;
  model.left.gain = -common::kGravity_m_s2;
  model.forward.lag_s = model.left.lag_s = 0.2;
  model.up.gain = common::kGravity_m_s2;
  model.up.offset = -common::kGravity_m_s2;
  model.up.lag_s = 0.05;
  model.yaw.gain = 1.0;
  return model;
}

inline FlightController::Config flightConfig(ControllerKind kind) {
  FlightController::Config config;
  config.controller.kind = kind;
  return config;
}

/// Whether that kind flies: a switch to it is then no event.
inline bool flies(FlightController& controller, common::EventLog& log, ControllerKind kind) {
  (void)log.take();
  return controller.command(SwitchController{kind}) && log.take().empty();
}

/// In the words of a test's name.
inline std::string nameOf(ControllerKind kind) {
  switch (kind) {
    case ControllerKind::kSwiftlet:
      return "Swiftlet";
    case ControllerKind::kCascadedPid:
      return "CascadedPid";
    case ControllerKind::kVoltagePid:
      return "VoltagePid";
    case ControllerKind::kLqr:
      return "Lqr";
    case ControllerKind::kSlidingMode:
      return "SlidingMode";
  }
  return "";
}

}  // namespace swiftlet::control
