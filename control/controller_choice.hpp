// The choice of the controller, and the settings of each kind.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/vehicle_config.hpp"
#include "control/controllers/cascaded_pid.hpp"
#include "control/controllers/lqr.hpp"
#include "control/controllers/sliding_mode.hpp"
#include "control/controllers/voltage_pid.hpp"
#include "control/position_controller.hpp"

namespace swiftlet::control {

/// The settings of the default kind are those of `position`, beside this section. Only the settings of the kinds that
/// fly have an effect.
struct ControllerChoiceConfig {
  ControllerKind kind = ControllerKind::kSwiftlet;
  CascadedPid::Config cascaded_pid;
  VoltagePid::Config voltage_pid;
  Lqr::Config lqr;
  SlidingMode::Config sliding_mode;

  void describe(common::config::Fields& fields);
};

/// The words of `controller.kind`, in the order of ControllerKind.
const std::vector<std::string>& controllerWords();

/// Null where the kind needs a model and `model` is null or lacks an axis.
std::unique_ptr<Controller> makeController(ControllerKind kind, const ControllerChoiceConfig& choice,
                                           const PositionController::Config& position,
                                           const common::VehicleConfig& vehicle, const VehicleModel* model);

}  // namespace swiftlet::control
