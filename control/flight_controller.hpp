// The action layer in one object: state machine, path follower, controller and emergency descent (Tomic 2012,
// "Action"). Ticked each kControlPeriod; returns the setpoint for the autopilot.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "common/clearance_along.hpp"
#include "common/config_fwd.hpp"
#include "common/event_log.hpp"
#include "common/facing.hpp"
#include "common/vehicle.hpp"
#include "common/vehicle_config.hpp"
#include "common/vehicle_state.hpp"
#include "common/world/flight_state.hpp"
#include "control/blind_escape.hpp"
#include "control/emergency_descent.hpp"
#include "control/estimate_watch.hpp"
#include "control/flight_state_machine.hpp"
#include "control/margin_limits.hpp"
#include "control/oscillation_guard.hpp"
#include "control/path_follower.hpp"
#include "control/surface_clearance.hpp"
#include "control/switched_controller.hpp"
#include "control/tick_clock.hpp"
#include "control/vertical_flight.hpp"

namespace swiftlet::control {

/// Preparation -> powered off. Call it when the fusion has been initialized on the ground.
struct Prepared {};
/// Takes off to this height over the take-off floor, which must be above the place where the vehicle stands. Engages
/// the motors if they are off.
struct TakeOff {
  double height_m = 1.0;
};
struct Land {};
struct DisengageMotors {};
/// Descends where it is, by the raw height, and switches the motors off on the ground; from any state in the air.
struct EmergencyLand {};
/// Changes the controller in any state, in flight without a step. Refused for one without its model.
struct SwitchController {
  ControllerKind kind = ControllerKind::kSwiftlet;
};
using FlightCommand = std::variant<Prepared, TakeOff, Land, DisengageMotors, EmergencyLand, SwitchController>;

/// A path in `map`. It moves with the map when SLAM corrects T_map_odom.
struct FlightPath {
  std::vector<Eigen::Vector3d> points_map_m;  ///< z over the take-off floor. The last one is the goal.
  common::FlightMode mode = common::FlightMode::kCareful;
  std::optional<double> goal_yaw_map_rad;
  /// In `map`, only asked while the path is given; null: the vehicle joins the path by the smoothest lines.
  common::ClearanceAlong clearance_m = {};
  std::vector<common::Facing> facings_map = {};  ///< See PathFollower::setPath.
};

/// The inputs of one tick.
struct FlightTick {
  common::Time now;
  common::VehicleState state;
  std::optional<RawHeight> raw_height;  ///< A height measured since the last tick, if there is one.
  double battery_v = 0.0;               ///< Latest voltage; 0 while unknown.
  bool fusion_diverged = false;
  /// Why the inertial samples cannot be used, for example "the inertial samples repeat"; empty if they can. The state
  /// is then one that setpoints predict, with a horizontal part that other sensors support or none. Only read in the
  /// tick itself.
  std::string_view inertial_fault;
  /// A part of the inertial samples is replaced by a prediction from the thrust.
  bool inertial_contradicted = false;
  /// The pilot has control: setpoints have no effect, and the references follow the vehicle.
  bool pilot_flies = false;
  /// The motors get the thrust of the last setpoint: while a pilot overrides it, the thrust model does not learn.
  bool thrust_applies = true;
  /// Roll and pitch of the horizon that the autopilot flies by, less those of the state: what a setpoint has to add.
  Eigen::Vector2d horizon_offset_rad = Eigen::Vector2d::Zero();
  /// From the accelerometer, without gravity and bias; nullopt while it is not known.
  std::optional<Eigen::Vector3d> acceleration_odom_m_s2 = std::nullopt;
};

/// One thread. Never throws; a refused command returns its reason.
class FlightController {
 public:
  struct Config {
    double climb_m_s = 0.5;
    double descent_m_s = 0.4;
    PathFollower::Config path;
    PositionController::Config position;
    ControllerChoiceConfig controller;
    SurfaceClearance::Config clearance;

    void describe(common::config::Fields& fields);
  };

  /// `model` is what was identified of the vehicle, or null; `learned` is what an earlier flight of this vehicle has
  /// learned of its thrust. Both are read only here.
  FlightController(const Config& config, const common::VehicleConfig& vehicle, common::EventLog& log,
                   const VehicleModel* model = nullptr, const ThrustPoints& learned = {});

  /// A refused command changes nothing and returns its reason.
  tl::expected<void, std::string> command(const FlightCommand& command);
  /// Allowed only while flying (Table 1). An empty path stops.
  tl::expected<void, std::string> follow(const FlightPath& path);
  /// Greatest speed on the present path; see PathFollower::setPace.
  void setPace(double speed_m_s) { follower_.setPace(speed_m_s); }
  /// Leaves the path and flies at that velocity until the next command; see PathFollower::setVelocity. Allowed only
  /// while flying.
  tl::expected<void, std::string> followVelocity(const Eigen::Vector2d& velocity_map_m_s, double acceleration_m_s2,
                                                 double yaw_map_rad, double climb_m_s = 0.0);
  /// Stops as fast as the flight mode allows and holds.
  void hold();
  /// While it is set, the nose faces that point of the map, on paths and while holding; not in a retreat. The point of
  /// the intent counts before that of the reactive layer.
  enum class Looks { kForIntent, kForReactive };
  void lookAt(const std::optional<Eigen::Vector2d>& point_map_m, Looks looks = Looks::kForIntent) {
    look_at_map_m_[static_cast<std::size_t>(looks)] = point_map_m;
  }
  /// The displacement, in `map`, that the vehicle flies by its velocity alone if the horizontal estimate is lost now,
  /// at most BlindEscape::kReach_m long; zero to brake and stay. While it is flown, paths and velocities are refused.
  void setEscape(const Eigen::Vector2d& displacement_map_m) { escape_.plan(displacement_map_m); }
  /// Speed limit of the reactive layer; infinity lifts it.
  void setSpeedLimit(double speed_m_s) { follower_.setSpeedLimit(speed_m_s); }

  /// How much higher than its path it flies because of what is below, within the greatest height.
  double lift_m() const { return clearance_.lift_m(); }

  /// Greatest height over the take-off floor. A take-off to more is refused, and paths stay below.
  void setMaxHeight(double height_m) { vertical_.setMaxHeight(height_m); }
  double maxHeight_m() const { return vertical_.maxHeight_m(); }

  common::Setpoint tick(const FlightTick& tick);

  common::FlightState state() const { return machine_.state(); }
  /// Why the controlled flight ended, for example "no valid height for 0.3 s". Empty from the take-off until the
  /// vehicle comes down.
  const std::string& groundedReason() const { return grounded_reason_; }
  /// On the ground, or flying with the reference at rest and the vehicle slow.
  bool stopped() const;
  /// The path and its reference, without the lift over what is below.
  const PathFollower& follower() const { return follower_; }
  const ThrustModel& thrust() const { return position_.thrust(); }
  /// The thrust that carries the weight: the learned hover command, and what the controller adds until that is learned.
  double carryingCommand() const;
  /// Duration of a landing from the present height onto the take-off floor.
  double landing_s() const { return vertical_.landing_s(last_state_.T_odom_body.position_m.z(), margin_); }

 private:
  tl::expected<void, std::string> takeOffTo(double height_m);
  /// Nothing if that state has been entered `already`.
  tl::expected<void, std::string> comeDown(FlightInput input, common::FlightState already, const char* reason);
  tl::expected<void, std::string> switchTo(ControllerKind kind);
  tl::expected<void, std::string> apply(FlightInput input, const std::string& reason);
  /// Why neither paths nor velocities, `what`, are flown now; empty if they are.
  std::string refusalToFollow(std::string_view what) const;

  /// An input that the present state does not accept changes nothing.
  void transition(FlightInput input, const std::string& reason);
  void enter(common::FlightState from, common::FlightState entered);
  void startEmergencyDescent();
  void beginAtVehicle();

  void watch(const FlightTick& tick);
  void watchHorizontal(const FlightTick& tick);
  void escape();
  void keepPathInMap(const common::Pose2& T_map_odom);
  void limitByMargin(const FlightTick& tick);
  bool learnsThrust(const FlightTick& tick) const;

  common::Setpoint setpointFor(const FlightTick& tick);
  common::Setpoint takeOff(const FlightTick& tick);
  common::Setpoint descend(const FlightTick& tick);
  common::Setpoint descendInEmergency(const FlightTick& tick);
  std::optional<Eigen::Vector2d> pointToFace() const;
  common::Setpoint track(const FlightTick& tick, const Reference& reference, bool on_ground = false);
  /// The part of the horizontal state that may be used.
  Horizontal horizontalFor(const FlightTick& tick) const;
  bool isVelocityCarried(const FlightTick& tick) const;
  bool velocityIsKnown() const;
  double bodyYaw_odom_rad() const;

  FlightStateMachine machine_;
  VerticalFlight vertical_;
  PathFollower follower_;
  SwitchedController position_;
  EmergencyDescent emergency_;
  BlindEscape escape_;
  SurfaceClearance clearance_;
  MarginLimits margin_;
  OscillationGuard oscillation_;
  EstimateWatch watch_;
  TickClock clock_;
  common::VehicleState last_state_;                              ///< The last finite one.
  std::array<std::optional<Eigen::Vector2d>, 2> look_at_map_m_;  ///< By Looks.
  std::string grounded_reason_;
  common::EventLog& log_;
};

}  // namespace swiftlet::control
