#include "control/switched_controller.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "control/usable_state.hpp"

namespace swiftlet::control {
namespace {

/// Time constant with which the step between two controllers fades when they are switched in flight.
constexpr double kBlend_s = 0.3;
constexpr double kFaded = 1e-4;  ///< A ten-thousandth of a radian or of the thrust is no step.

}  // namespace

SwitchedController::SwitchedController(const ControllerChoiceConfig& choice, const PositionController::Config& position,
                                       const common::VehicleConfig& vehicle, const VehicleModel* model)
    : max_tilt_rad_(vehicle.max_tilt_deg * common::kRadPerDeg), thrust_(position.thrust, vehicle), kind_(choice.kind) {
  for (int i = 0; i < kControllerKinds; ++i)
    controllers_[static_cast<std::size_t>(i)] =
        makeController(static_cast<ControllerKind>(i), choice, position, vehicle, model);
  if (!controllers_[static_cast<std::size_t>(kind_)]) kind_ = ControllerKind::kSwiftlet;
  if (model != nullptr) thrust_.table().recall(model->thrust);
}

void SwitchedController::reset() {
  controller().reset();
  step_.setZero();
  switched_ = false;
}

tl::expected<void, std::string> SwitchedController::switchTo(ControllerKind kind) {
  if (kind == kind_) return {};
  const auto& next = controllers_[static_cast<std::size_t>(kind)];
  if (!next)
    return tl::unexpected(
        std::string(toString(kind)) +
        " needs a vehicle_model with every axis identified, and weights for which its gains converge");
  next->reset();
  next->setTrim(controller().trim_odom_m_s2(thrust_), thrust_);
  kind_ = kind;
  switched_ = last_.has_value();
  return {};
}

common::Setpoint SwitchedController::tick(const ControlInput& input, double battery_v) {
  thrust_.observeVoltage(battery_v, input.dt_s);
  common::Setpoint setpoint;
  if (isFinite(input.state)) {
    ControlInput allowed = input;
    if (input.on_ground) allowed.horizontal = Horizontal::kLevel;
    setpoint = controller().tick(allowed, thrust_);
    blend(setpoint, input.dt_s);
  } else {
    setpoint.thrust = thrust_.hoverCommand();
  }
  setpoint.stamp = input.now;
  setpoint.motors_on = true;
  last_ = Command(setpoint.roll_rad, setpoint.pitch_rad, setpoint.yaw_rate_rad_s, setpoint.thrust);
  return setpoint;
}

void SwitchedController::blend(common::Setpoint& setpoint, double dt_s) {
  const Command own(setpoint.roll_rad, setpoint.pitch_rad, setpoint.yaw_rate_rad_s, setpoint.thrust);
  if (switched_) step_ = *last_ - own;
  switched_ = false;
  if (step_.isZero(0.0)) return;
  setpoint.roll_rad = std::clamp(own[0] + step_[0], -max_tilt_rad_, max_tilt_rad_);
  setpoint.pitch_rad = std::clamp(own[1] + step_[1], -max_tilt_rad_, max_tilt_rad_);
  setpoint.yaw_rate_rad_s = own[2] + step_[2];
  setpoint.thrust = thrust_.clamped(own[3] + step_[3]);
  step_ *= std::exp(-dt_s / kBlend_s);
  if (step_.cwiseAbs().maxCoeff() < kFaded) step_.setZero();
}

}  // namespace swiftlet::control
