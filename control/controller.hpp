// The one interface of the controllers: state and reference in, setpoint out. Each law is a file of control/controllers
// or control/position_controller, which has the default.
#pragma once

#include <optional>
#include <string_view>

#include <Eigen/Core>

#include "common/time.hpp"
#include "common/vehicle.hpp"
#include "common/vehicle_state.hpp"
#include "control/reference.hpp"
#include "control/thrust_model.hpp"

namespace swiftlet::control {

/// In the order of the words of `controller.kind`.
enum class ControllerKind {
  kSwiftlet,     ///< Cascaded PID with feedforward and a delayed reference: the default.
  kCascadedPid,  ///< Saeedi, III-E.
  kVoltagePid,   ///< Grzonka 2009, equations 9 and 10; Grzonka 2012, equations 3 to 5.
  kLqr,          ///< Bachrach 2009, equations 1 and 2; it needs a model of the vehicle.
  kSlidingMode,  ///< Tomic 2012, "Action".
};
inline constexpr int kControllerKinds = 5;
const char* toString(ControllerKind kind);
/// The kind with that word; nullopt for any other.
std::optional<ControllerKind> controllerNamed(std::string_view word);

/// The part of the horizontal state that a controller may use.
enum class Horizontal {
  kPosition,  ///< Hold the reference.
  kVelocity,  ///< The position is unknown: only the velocity of the reference is held.
  kLevel,     ///< Neither is known: keep the trim learned so far.
};

/// The inputs of one tick. The state is finite.
struct ControlInput {
  common::Time now;
  double dt_s = common::kControlPeriod.seconds();
  common::VehicleState state;
  Reference reference;
  /// From the accelerometer, without gravity and bias; nullopt while it is not known.
  std::optional<Eigen::Vector3d> acceleration_odom_m_s2;
  Horizontal horizontal = Horizontal::kPosition;
  /// The vehicle stands: the tilt and the yaw rate stay zero, and neither the horizontal integrals nor the learned
  /// hover command change. `horizontal` is then kLevel.
  bool on_ground = false;
  /// Share of the horizontal gains to use; less than 1 while roll and pitch swing. The controllers of the papers keep
  /// theirs.
  double horizontal_share = 1.0;
};

/// One thread; called each kControlPeriod while the vehicle is in control. tick() allocates nothing and never throws.
class Controller {
 public:
  virtual ~Controller() = default;

  /// Forgets integrals and estimated disturbances.
  virtual void reset() = 0;

  /// The setpoint; its stamp and motors_on are set by the caller. `thrust` has the voltage already, and learns here.
  virtual common::Setpoint tick(const ControlInput& input, ThrustModel& thrust) = 0;

  /// The constant acceleration that the controller adds against wind, a wrong horizon and a wrong thrust model, as
  /// learned so far.
  virtual Eigen::Vector3d trim_odom_m_s2(const ThrustModel& thrust) const = 0;
  /// Takes over the trim of another controller, as far as this one has an integral.
  virtual void setTrim(const Eigen::Vector3d& trim_odom_m_s2, const ThrustModel& thrust) = 0;
};

}  // namespace swiftlet::control
