// The action layer in one object: state machine, path follower, controller and emergency descent (Tomic 2012,
// "Action"). Ticked each kControlPeriod; returns the setpoint for the autopilot.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "common/config_fwd.hpp"
#include "common/event_log.hpp"
#include "common/vehicle.hpp"
#include "common/vehicle_config.hpp"
#include "common/vehicle_state.hpp"
#include "common/world/flight_state.hpp"
#include "control/emergency_descent.hpp"
#include "control/flight_state_machine.hpp"
#include "control/margin_limits.hpp"
#include "control/oscillation_guard.hpp"
#include "control/path_follower.hpp"
#include "control/surface_clearance.hpp"
#include "control/switched_controller.hpp"

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
using FlightCommand = std::variant<Prepared, TakeOff, Land, DisengageMotors, EmergencyLand>;

/// A path in `map`. It moves with the map when SLAM corrects T_map_odom.
struct FlightPath {
  std::vector<Eigen::Vector3d> points_map_m;  ///< z over the take-off floor. The last one is the goal.
  common::FlightMode mode = common::FlightMode::kCareful;
  std::optional<double> goal_yaw_map_rad;
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
    static constexpr double spool_up_s = 0.8;  ///< Time from starting the motors to lifting.
    double climb_m_s = 0.5;
    double descent_m_s = 0.4;
    static constexpr double touchdown_descent_m_s = 0.2;  ///< Descent speed near the ground.
    static constexpr double touchdown_height_m =
        0.4;  ///< Height over what is below at which the ground counts as near.
    static constexpr double take_off_timeout_s =
        15.0;  ///< Without hovering this long after the climb should have ended the vehicle lands again.
    static constexpr double climb_acceleration_m_s2 = 0.8;  ///< Vertical acceleration of taking off and landing.
    static constexpr double hover_tolerance_m = 0.10;       ///< Taking off ends this close to the height.
    static constexpr double hover_speed_m_s = 0.15;  ///< Taking off ends only when the vehicle is slower than this.
    static constexpr double hover_s = 0.4;  ///< Taking off ends when the vehicle has been close and slow for this long.
    static constexpr double touchdown_thrust =
        0.7;  ///< Below this share of the hover command the ground carries the vehicle.
    static constexpr double touchdown_s =
        0.3;  ///< The vehicle has landed when the ground has carried it for this long.
    static constexpr double stopped_speed_m_s = 0.10;  ///< Slower than this the vehicle has stopped.
    static constexpr double horizontal_loss_s =
        1.0;  ///< Without a horizontal estimate for this long the vehicle lands level.
    static constexpr double blind_speed_m_s = 0.3;  ///< Speed at which a vehicle that has lost its horizontal estimate
                                                    ///< leaves the walls, by its velocity alone.
    static constexpr double blind_acceleration_m_s2 = 0.6;  ///< Acceleration to blind_speed_m_s.
    static constexpr double blind_s =
        2.0;  ///< Longest flight by the velocity alone after the horizontal estimate was lost: a carried velocity that
              ///< is off by 0.1 m/s leads 0.2 m astray in 2 s.
    static constexpr double vertical_loss_s =
        0.3;  ///< Without a vertical estimate for this long the emergency descent begins.
    static constexpr double inertial_age_s =
        0.1;  ///< An estimate whose newest inertial sample is older than this cannot be used.
    static constexpr double inertial_loss_s = 0.2;  ///< The emergency descent begins when inertial samples that cannot
                                                    ///< be used have been noticed for this long.
    MarginLimits::Config margin;
    PathFollower::Config path;
    PositionController::Config position;
    ControllerChoiceConfig controller;
    EmergencyDescent::Config emergency;
    SurfaceClearance::Config clearance;
    OscillationGuard::Config oscillation;

    void describe(common::config::Fields& fields);
  };

  /// `model` is what was identified of the vehicle, or null; it is read only here.
  FlightController(const Config& config, const common::VehicleConfig& vehicle, common::EventLog& log,
                   const VehicleModel* model = nullptr);

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
  /// While it is set, the nose faces that point of the map, on paths and while holding; not in a retreat.
  void lookAt(const std::optional<Eigen::Vector2d>& point_map_m) { look_at_map_m_ = point_map_m; }
  /// Changes the controller in any state, in flight without a step. Fails, with the reason, for one without its model.
  tl::expected<void, std::string> switchController(ControllerKind kind);
  ControllerKind controllerKind() const { return position_.kind(); }
  /// The displacement, in `map`, that the vehicle flies by its velocity alone if the horizontal estimate is lost now,
  /// at most escapeReach_m() long; zero to brake and stay. While it is flown, paths and velocities are refused.
  void setEscape(const Eigen::Vector2d& displacement_map_m) { escape_map_m_ = displacement_map_m; }
  double escapeReach_m() const { return config_.blind_s * config_.blind_speed_m_s; }
  /// Speed limit of the reactive layer; infinity lifts it.
  void setSpeedLimit(double speed_m_s) { follower_.setSpeedLimit(speed_m_s); }

  /// How much higher than its path it flies because of what is below, within the greatest height.
  double lift_m() const { return lift_m_; }

  /// Greatest height over the take-off floor. A take-off to more is refused, and paths stay below.
  void setMaxHeight(double height_m) { max_height_m_ = height_m; }
  double maxHeight_m() const { return max_height_m_; }

  common::Setpoint tick(const FlightTick& tick);

  common::FlightState state() const { return machine_.state(); }
  /// Why the controlled flight ended, for example "no valid height for 0.3 s". Empty from the take-off until the
  /// vehicle comes down.
  const std::string& groundedReason() const { return grounded_reason_; }
  /// On the ground, or flying with the reference at rest and the vehicle slow.
  bool stopped() const;
  /// The last path is still being flown: no hold, no lost estimate and no pilot has interrupted it.
  bool followsPath() const { return follower_.followsPath(); }
  const ThrustModel& thrust() const { return position_.thrust(); }
  /// See ThrustModel::margin().
  double thrustMargin() const { return position_.thrust().margin(); }
  /// The thrust that carries the weight: the learned hover command, and what the controller adds until that is learned.
  double carryingCommand() const;
  /// What an earlier flight of this vehicle has learned, to be called before the first tick; and what is known now.
  void recallThrust(const ThrustPoints& points) { position_.thrust().table().recall(points); }
  ThrustPoints learnedThrust() const { return position_.thrust().table().points(); }
  /// With the present thrust margin.
  double speed_m_s(common::FlightMode mode) const { return margin_.speed() * config_.path.limits(mode).speed_m_s; }
  double brakingDistance_m(common::FlightMode mode, double speed_m_s) const {
    return 0.5 * speed_m_s * speed_m_s / (margin_.acceleration() * config_.path.limits(mode).acceleration_m_s2);
  }
  /// Duration of a landing from the present height onto the take-off floor.
  double landing_s() const;
  /// Length of the rest of the last path.
  double pathRemaining_m() const { return follower_.remaining_m(); }
  /// The reference has reached the goal of the last path.
  bool pathFinished() const { return follower_.finished(); }
  const Reference& reference() const { return follower_.reference(); }

 private:
  /// An input that the present state does not accept changes nothing.
  void transition(FlightInput input, const std::string& reason);
  void enter(common::FlightState from, common::FlightState entered);
  void say(common::Severity severity, std::string text, std::string reason = {},
           common::Concern concern = common::Concern::kNone);
  void watch(const FlightTick& tick);
  void watchInertial(std::string_view fault);
  void watchHorizontal(const FlightTick& tick);
  void escape();
  void keepPathInMap(const common::VehicleState& state);
  common::Setpoint setpointFor(const FlightTick& tick);
  common::Setpoint takeOff(const FlightTick& tick);
  std::optional<Eigen::Vector2d> pointToFace() const;
  common::Setpoint fly(const FlightTick& tick);
  Reference clearOfSurfaces(Reference reference);
  common::Setpoint descend(const FlightTick& tick);
  common::Setpoint descendInEmergency(const FlightTick& tick);
  common::Setpoint track(const FlightTick& tick, const Reference& reference, bool on_ground = false);
  void limitByMargin(const FlightTick& tick);
  bool learnsThrust(const FlightTick& tick) const;
  bool nearGround() const;
  void moveVertically(double goal_m, double speed_m_s, double height_m);
  Eigen::Vector2d velocityForBraking_m_s() const;
  void startEmergencyDescent();
  void beginAtVehicle();
  /// Whether the condition has held for this long; `since` keeps when it began.
  bool heldFor(std::optional<common::Time>& since, bool condition, double seconds) const;

  Config config_;
  FlightStateMachine machine_;
  MarginLimits margin_;
  PathFollower follower_;
  SwitchedController position_;
  EmergencyDescent emergency_;
  SurfaceClearance clearance_;
  OscillationGuard oscillation_;
  double lift_m_ = 0.0;  ///< Lift of the last reference.
  common::EventLog& log_;
  std::string grounded_reason_;

  common::Time now_;
  bool ticked_ = false;
  double dt_s_;
  common::VehicleState last_state_;
  common::Pose2 T_map_odom_;
  double standing_height_m_ = 0.0;  ///< Height of the body origin over the take-off floor while standing.
  double standing_raw_m_ = 0.0;     ///< Height that the mirror measures while standing.
  double take_off_height_m_ = 1.0;
  std::optional<Eigen::Vector2d> look_at_map_m_;
  double max_height_m_;
  double height_reference_m_ = 0.0;  ///< Moved by the controller itself during take-off and landing.
  double climb_reference_m_s_ = 0.0;
  bool lifted_ = false;
  common::Time state_since_;
  std::optional<common::Time> spent_since_;      ///< Since when a take-off has had all of the thrust.
  std::optional<common::Time> condition_since_;  ///< Since when the vehicle has hovered, or touched the ground.
  std::optional<common::Time> horizontal_lost_;
  Eigen::Vector2d escape_map_m_ = Eigen::Vector2d::Zero();
  std::optional<common::Time> escapes_until_;  ///< Flies the escape until then.
  std::optional<common::Time> vertical_lost_;
  std::optional<common::Time> inertial_lost_;
  std::string inertial_fault_;
};

}  // namespace swiftlet::control
