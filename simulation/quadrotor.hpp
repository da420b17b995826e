// The rigid body in the air: four lagging motors in X, drag against the wind, a sagging battery and a floor to stand
// on.
#pragma once

#include <array>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/geometry.hpp"
#include "common/vehicle_config.hpp"
#include "simulation/plant_config.hpp"

namespace swiftlet::simulation {

/// The airframe of a vehicle: the inertias, the arm, the drag and the rotors' power of a QuadrotorConfig are those for
/// the mass and the arm of the default data sheet, and scale with those of another.
QuadrotorConfig scaledTo(const common::VehicleConfig& vehicle, QuadrotorConfig config);

/// Thrust over weight in steady state: all motors at the same throttle, at the voltage that their current leaves.
/// `lost_cells`: as Battery::loseCells.
double thrustOverWeight(const common::VehicleConfig& vehicle, const QuadrotorConfig& airframe, double battery_remaining,
                        double throttle, int lost_cells = 0);

/// Thrusts by motor: front left, front right, rear right, rear left; front left and rear right turn clockwise.
using MotorThrusts = std::array<double, 4>;

struct QuadrotorState {
  common::Pose3 T_world_body;
  Eigen::Vector3d velocity_world_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity_body_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d specific_force_body_m_s2 = Eigen::Vector3d::Zero();  ///< As an accelerometer measures it.
  MotorThrusts thrusts_n{};                                            ///< Present thrusts, after the lag.
  bool standing = true;                                                ///< The feet carry the weight.
};

/// Advances by fixed steps. The caller finds the floor and judges contacts.
class Quadrotor {
 public:
  Quadrotor(const common::VehicleConfig& vehicle, const QuadrotorConfig& config, const common::Pose3& T_world_body,
            double battery_remaining);

  const QuadrotorState& state() const { return state_; }
  const Battery& battery() const { return battery_; }

  /// One step. `throttles` in [0, 1] are what the autopilot asks of each motor. A motor's thrust at full battery goes
  /// with the throttle to the power of `throttle_exponent` and falls with the voltage. `floor_world_m` is the height of
  /// the floor below the feet, -infinity for none.
  void step(const std::array<double, 4>& throttles, const Eigen::Vector3d& wind_world_m_s, double floor_world_m,
            double step_s);

  /// Tells where the nearest wall is, from now on: the direction to it, of any length, and the distance from the hull.
  void feelWall(const Eigen::Vector2d& towards_wall_world, double gap_m);

  /// As Battery::loseCells.
  void loseCells(int count) { battery_.loseCells(count); }

  /// A push at the centre of mass, spread over 0.1 s, as long as the touch of a hand.
  void push(const Eigen::Vector3d& impulse_world_n_s);

  /// Moves it in the next step beside all that acts on it, as a hand does: horizontally, and about the body's z.
  void lead(const Eigen::Vector2d& acceleration_world_m_s2, double yaw_acceleration_rad_s2);

  /// Holds it on a bench, after each step: it stays where it was, and turns only about x (0) or y (1) of its body.
  void holdOnBench(int axis_body, const Eigen::Vector3d& place_world_m);

  /// How far the gear gives way under the standing vehicle.
  static constexpr double kGearSag_m = 0.004;

 private:
  void spinMotors(const std::array<double, 4>& throttles, double step_s);
  double groundEffect(double floor_world_m) const;
  Eigen::Vector3d takePush(double step_s);
  double gearForce_n(double floor_world_m) const;
  Eigen::Vector3d gearAngularAcceleration(double gear_n) const;
  void applyFriction(double gear_n, double step_s);

  common::VehicleConfig vehicle_;
  QuadrotorConfig config_;
  QuadrotorState state_;
  Battery battery_;
  Eigen::Vector3d push_world_n_s_ = Eigen::Vector3d::Zero();  ///< The part of the push that is still to come.
  double push_left_s_ = 0.0;
  Eigen::Vector3d led_world_m_s2_ = Eigen::Vector3d::Zero();  ///< What a hand adds in the next step.
  double led_yaw_rad_s2_ = 0.0;
  /// Pull of the wall, as a share of the thrust.
  Eigen::Vector2d wall_pull_world_ = Eigen::Vector2d::Zero();
};

}  // namespace swiftlet::simulation
