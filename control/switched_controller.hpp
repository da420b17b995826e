// One controller of several, which can be switched in flight without a step of any command (Tomic 2012, "Action":
// in-flight switching of position controller implementations).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "control/controller_choice.hpp"

namespace swiftlet::control {

/// Owns the controllers and the thrust model that they share. All kinds are made at the start, so that neither a tick
/// nor a switch allocates.
///
/// ```
///   switchTo(kind): reset the next, give it the trim of the last
///   next tick:      step = last setpoint - first setpoint of the next
///   from then on:   setpoint = setpoint of the next + step * exp(-t / kBlend_s)
/// ```
/// Call at 100 Hz from one thread. A NaN in the state never reaches the setpoint, which is then level at hover thrust.
class SwitchedController {
 public:
  /// `model` is what was identified of the vehicle, or null; it is read only here. Without one, a choice of lqr flies
  /// the default controller: profiles are checked for it before.
  SwitchedController(const ControllerChoiceConfig& choice, const PositionController::Config& position,
                     const common::VehicleConfig& vehicle, const VehicleModel* model);

  /// Resets the integrals and ends a blend; the learned hover command stays.
  void reset();
  /// From the next tick on. Fails, with the reason, for a kind that needs a model that is not there.
  tl::expected<void, std::string> switchTo(ControllerKind kind);
  ControllerKind kind() const { return kind_; }

  common::Setpoint tick(const ControlInput& input, double battery_v);

  /// The horizontal acceleration that balances wind and a wrong horizon, as learned so far.
  Eigen::Vector3d trim_odom_m_s2() const { return controller().trim_odom_m_s2(thrust_); }
  ThrustModel& thrust() { return thrust_; }
  const ThrustModel& thrust() const { return thrust_; }

 private:
  /// Roll, pitch, yaw rate and thrust.
  using Command = Eigen::Vector4d;
  Controller& controller() const { return *controllers_[static_cast<std::size_t>(kind_)]; }
  void blend(common::Setpoint& setpoint, double dt_s);

  double max_tilt_rad_;
  ThrustModel thrust_;
  std::array<std::unique_ptr<Controller>, kControllerKinds> controllers_;
  ControllerKind kind_;
  bool switched_ = false;  ///< The present controller has not ticked since the switch.
  std::optional<Command> last_;
  Command step_ = Command::Zero();
};

}  // namespace swiftlet::control
