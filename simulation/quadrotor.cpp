#include "simulation/quadrotor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/config_fields.hpp"
#include "common/first_order_lag.hpp"
#include "common/gravity.hpp"

namespace swiftlet::simulation {

using Eigen::Vector3d;

QuadrotorConfig scaledTo(const common::VehicleConfig& vehicle, QuadrotorConfig config) {
  const common::VehicleConfig standard;
  const double mass = vehicle.mass_kg / standard.mass_kg, size = vehicle.arm_m / standard.arm_m;
  for (double* inertia :
       {&config.inertia_xx_kg_m2, &config.inertia_yy_kg_m2, &config.inertia_zz_kg_m2, &config.angular_drag_n_m_s})
    *inertia *= mass * size * size;
  config.arm_m *= size;
  config.linear_drag_n_s_m *= size * size;
  config.quadratic_drag_n_s2_m2 *= size * size;
  config.battery.power_w_per_n15 /= size;  // Momentum theory: the induced power goes with 1 / radius.
  return config;
}

void QuadrotorConfig::describe(common::config::Fields& fields) {
  fields("inertia_xx_kg_m2", inertia_xx_kg_m2, {1e-4, 10},
         "Moment of inertia about the forward axis, for the mass and arm of the default vehicle; others scale.");
  fields("inertia_yy_kg_m2", inertia_yy_kg_m2, {1e-4, 10}, "Moment of inertia about the left axis.");
  fields("inertia_zz_kg_m2", inertia_zz_kg_m2, {1e-4, 10}, "Moment of inertia about the up axis.");
  fields("arm_m", arm_m, {0.02, 2},
         "Distance from the centre to a rotor's axis, for the arm of the default vehicle; others scale.");
  fields("torque_per_thrust_m", torque_per_thrust_m, {0.001, 0.5},
         "Reaction torque of a rotor about its axis per newton of thrust.");
  fields("motor_lag_s", motor_lag_s, {0.005, 0.5}, "Time constant of a motor's thrust.");
  fields("linear_drag_n_s_m", linear_drag_n_s_m, {0, 10}, "Drag per speed through the air.");
  fields("quadratic_drag_n_s2_m2", quadratic_drag_n_s2_m2, {0, 10}, "Drag per squared speed through the air.");
  fields("angular_drag_n_m_s", angular_drag_n_m_s, {0, 1}, "Torque against turning per turn rate.");
  fields("gear_height_m", gear_height_m, {0.01, 2},
         "Height of the body's origin over the feet, which are below the hull.");
  fields("gear_radius_m", gear_radius_m, {0.01, 2}, "Distance from the centre to a foot.");
  fields("mass_share", mass_share, {0.5, 2}, "True mass over that of the data sheet.");
  fields("thrust_share", thrust_share, {0.3, 2}, "True greatest thrust over that of the data sheet.");
  fields("throttle_exponent", throttle_exponent, {0.5, 3}, "A motor's thrust goes with the throttle to this power.");
  fields("weak_motor", weak_motor, {0, 4},
         "Motor that is weaker than the others: 1 front left, 2 front right, 3 rear right, 4 rear left, 0 none.");
  fields("weak_motor_share", weak_motor_share, {0.1, 1}, "Thrust of the weak motor over that of the others.");
  fields("ground_effect_radius_m", ground_effect_radius_m, {0, 1},
         "Rotor radius of the ground effect (Cheeseman and Bennett 1955); 0 without it.");
  fields("wall_effect_share", wall_effect_share, {0, 0.5},
         "Pull towards a wall that touches the hull, over the thrust; 0 without it.");
  fields("wall_effect_range_m", wall_effect_range_m, {0.01, 2},
         "Distance from the hull to a wall at which the wall's pull has fallen to 1 / e.");
  fields.section("battery", battery, "The battery.");
}

namespace {

double motorPower_w(const QuadrotorConfig& config, double thrust_n) {
  return config.battery.power_w_per_n15 * thrust_n * std::sqrt(thrust_n);
}

/// A motor's greatest thrust at full battery; `motor` counts from 0.
double fullThrust_n(const common::VehicleConfig& vehicle, const QuadrotorConfig& config, std::size_t motor) {
  const double sound_n = 0.25 * vehicle.max_thrust_n * config.thrust_share;
  return static_cast<int>(motor) + 1 == config.weak_motor ? sound_n * config.weak_motor_share : sound_n;
}

double throttleShare(const QuadrotorConfig& config, double throttle) {
  const double share = std::clamp(throttle, 0.0, 1.0);
  return config.throttle_exponent == 1.0 ? share : std::pow(share, config.throttle_exponent);
}

/// Thrust of a rotor in still air near the ground over that far from it (Cheeseman and Bennett 1955, equation 3).
double groundEffectAt(double rotor_radius_m, double height_m) {
  constexpr double kNearest = 0.5;  // In radii; below it the formula leaves its measurements.
  const double height = std::max(height_m / rotor_radius_m, kNearest);
  return 1.0 / (1.0 - 1.0 / (16.0 * height * height));
}

}  // namespace

double thrustOverWeight(const common::VehicleConfig& vehicle, const QuadrotorConfig& config, double battery_remaining,
                        double throttle, int lost_cells) {
  const QuadrotorConfig airframe = scaledTo(vehicle, config);
  Battery battery(vehicle, airframe.battery, battery_remaining);
  battery.loseCells(lost_cells);
  double thrust_n = 0.0;
  for (int round = 0; round < 50; ++round) {  // Less thrust, less current, less sag: converges in a few rounds.
    double power_w = 0.0;
    thrust_n = 0.0;
    for (std::size_t motor = 0; motor < 4; ++motor) {
      const double one_n =
          fullThrust_n(vehicle, airframe, motor) * battery.thrustShare() * throttleShare(airframe, throttle);
      thrust_n += one_n;
      power_w += motorPower_w(airframe, one_n);
    }
    battery.draw(power_w, 0.0);
  }
  return thrust_n / (vehicle.mass_kg * airframe.mass_share * common::kGravity_m_s2);
}

Quadrotor::Quadrotor(const common::VehicleConfig& vehicle, const QuadrotorConfig& config,
                     const common::Pose3& T_world_body, double battery_remaining)
    : vehicle_(vehicle), config_(scaledTo(vehicle, config)), battery_(vehicle, config_.battery, battery_remaining) {
  vehicle_.mass_kg *= config.mass_share;
  state_.T_world_body = T_world_body;
  state_.specific_force_body_m_s2 = common::kGravity_m_s2 * Vector3d::UnitZ();
}

void Quadrotor::spinMotors(const std::array<double, 4>& throttles, double step_s) {
  const double sag = battery_.thrustShare();
  const double blend = common::followedShare(step_s, config_.motor_lag_s);
  double power_w = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    double& thrust_n = state_.thrusts_n[i];
    const double wanted_n = fullThrust_n(vehicle_, config_, i) * sag * throttleShare(config_, throttles[i]);
    thrust_n += blend * (wanted_n - thrust_n);
    power_w += motorPower_w(config_, thrust_n);
  }
  battery_.draw(power_w, step_s);
}

void Quadrotor::step(const std::array<double, 4>& throttles, const Vector3d& wind_world_m_s, double floor_world_m,
                     double step_s) {
  spinMotors(throttles, step_s);
  const auto& f = state_.thrusts_n;
  const Eigen::Quaterniond& R_world_body = state_.T_world_body.rotation;

  // Forces other than gravity, in the world: thrust along the body's z, drag against the air, the floor, and a push.
  const Vector3d airspeed_world = state_.velocity_world_m_s - wind_world_m_s;
  const Vector3d drag_world =
      -(config_.linear_drag_n_s_m + config_.quadratic_drag_n_s2_m2 * airspeed_world.norm()) * airspeed_world;
  const double gear_n = gearForce_n(floor_world_m);
  Vector3d force_world = R_world_body * Vector3d(0.0, 0.0, groundEffect(floor_world_m) * (f[0] + f[1] + f[2] + f[3])) +
                         drag_world + Vector3d(0.0, 0.0, gear_n) + takePush(step_s);
  if (config_.wall_effect_share > 0.0) force_world.head<2>() += (f[0] + f[1] + f[2] + f[3]) * wall_pull_world_;
  const Vector3d acceleration_world = force_world / vehicle_.mass_kg - common::kGravity_m_s2 * Vector3d::UnitZ() +
                                      std::exchange(led_world_m_s2_, Vector3d::Zero());

  // Euler's equation in the body frame. Motors: front left, front right, rear right, rear left.
  const double lever_m = config_.arm_m / std::sqrt(2.0);
  const Vector3d torque(lever_m * (f[0] + f[3] - f[1] - f[2]), lever_m * (f[2] + f[3] - f[0] - f[1]),
                        config_.torque_per_thrust_m * (f[0] + f[2] - f[1] - f[3]));
  const Vector3d inertia(config_.inertia_xx_kg_m2, config_.inertia_yy_kg_m2, config_.inertia_zz_kg_m2);
  Vector3d& omega = state_.angular_velocity_body_rad_s;
  const Vector3d angular_acceleration =
      (torque - config_.angular_drag_n_m_s * omega - omega.cross(inertia.cwiseProduct(omega))).cwiseQuotient(inertia) +
      gearAngularAcceleration(gear_n) + std::exchange(led_yaw_rad_s2_, 0.0) * Vector3d::UnitZ();

  // Semi-implicit Euler: the new velocities move the pose.
  const Vector3d velocity_before = state_.velocity_world_m_s;
  state_.velocity_world_m_s += step_s * acceleration_world;
  omega += step_s * angular_acceleration;
  state_.T_world_body.position_m += step_s * state_.velocity_world_m_s;
  state_.T_world_body.rotation = (R_world_body * common::expSO3(step_s * omega)).normalized();

  state_.standing = gear_n > 0.0;
  if (state_.standing) applyFriction(gear_n, step_s);

  const Vector3d felt_world =
      (state_.velocity_world_m_s - velocity_before) / step_s + common::kGravity_m_s2 * Vector3d::UnitZ();
  state_.specific_force_body_m_s2 = state_.T_world_body.rotation.conjugate() * felt_world;
}

void Quadrotor::holdOnBench(int axis_body, const Vector3d& place_world_m) {
  const common::RollPitchYaw angles = common::rollPitchYaw(state_.T_world_body.rotation);
  const double angle_rad = axis_body == 0 ? angles.roll_rad : angles.pitch_rad;
  const Vector3d axis = Vector3d::Unit(axis_body);
  state_.T_world_body = {Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis)), place_world_m};
  state_.velocity_world_m_s.setZero();
  state_.angular_velocity_body_rad_s = axis * state_.angular_velocity_body_rad_s[axis_body];
  state_.specific_force_body_m_s2 =
      state_.T_world_body.rotation.conjugate() * Vector3d(0.0, 0.0, common::kGravity_m_s2);
}

double Quadrotor::groundEffect(double floor_world_m) const {
  if (config_.ground_effect_radius_m <= 0.0 || !std::isfinite(floor_world_m)) return 1.0;
  return groundEffectAt(config_.ground_effect_radius_m, state_.T_world_body.position_m.z() - floor_world_m);
}

// The suction between rotors and wall grows with the thrust and falls with the distance (Yang 2025); that it falls
// exponentially is a simplification.
void Quadrotor::feelWall(const Eigen::Vector2d& towards_wall_world, double gap_m) {
  const double share = config_.wall_effect_share * std::exp(-gap_m / config_.wall_effect_range_m);
  wall_pull_world_ = share * towards_wall_world.normalized();
}

// A critically damped spring that gives way by kGearSag_m under the vehicle's weight.
double Quadrotor::gearForce_n(double floor_world_m) const {
  const double pressed_m = floor_world_m + config_.gear_height_m - state_.T_world_body.position_m.z();
  if (!(pressed_m > 0.0)) return 0.0;
  const double frequency_rad_s = std::sqrt(common::kGravity_m_s2 / kGearSag_m);
  return std::max(
      0.0, vehicle_.mass_kg * frequency_rad_s * (frequency_rad_s * pressed_m - 2.0 * state_.velocity_world_m_s.z()));
}

// The feet stop a turn within some hundredths of a second and push the body level. This is modelled as a torque, so
// that the gyroscopes still measure the motion of the body while the motors lean it against the floor.
Vector3d Quadrotor::gearAngularAcceleration(double gear_n) const {
  // Critically damped; 1 / 33 s = 0.03 s.
  constexpr double kFrequency_rad_s = 33.0;
  const double carried = std::min(1.0, gear_n / (vehicle_.mass_kg * common::kGravity_m_s2));
  const common::RollPitchYaw angles = common::rollPitchYaw(state_.T_world_body.rotation);
  const Vector3d lean_rad(angles.roll_rad, angles.pitch_rad, 0.0);
  return -carried *
         (kFrequency_rad_s * kFrequency_rad_s * lean_rad + 2.0 * kFrequency_rad_s * state_.angular_velocity_body_rad_s);
}

// Dry friction holds the feet; the coefficient is that of rubber on a smooth floor.
void Quadrotor::applyFriction(double gear_n, double step_s) {
  constexpr double kFriction = 0.8;
  auto slide = state_.velocity_world_m_s.head<2>();
  const double speed = slide.norm(), stopped = kFriction * gear_n / vehicle_.mass_kg * step_s;
  slide *= speed > stopped ? 1.0 - stopped / speed : 0.0;
}

void Quadrotor::lead(const Eigen::Vector2d& acceleration_world_m_s2, double yaw_acceleration_rad_s2) {
  led_world_m_s2_.head<2>() += acceleration_world_m_s2;
  led_yaw_rad_s2_ += yaw_acceleration_rad_s2;
}

void Quadrotor::push(const Vector3d& impulse_world_n_s) {
  constexpr double kPush_s = 0.1;
  push_world_n_s_ += impulse_world_n_s;
  push_left_s_ = kPush_s;
}

Vector3d Quadrotor::takePush(double step_s) {
  if (push_left_s_ <= 0.0) return Vector3d::Zero();
  Vector3d force = push_world_n_s_ / std::max(push_left_s_, step_s);
  push_world_n_s_ -= step_s * force;
  push_left_s_ -= step_s;
  return force;
}

}  // namespace swiftlet::simulation
