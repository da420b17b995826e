#include "simulation/vehicle_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/gravity.hpp"

namespace swiftlet::simulation {
namespace {

using common::Time;

constexpr std::uint64_t kStepsPerAutopilotTick = 2;  // 500 Hz.
const Eigen::Vector3f kHullColor(0.2F, 0.35F, 0.75F);

common::Pose3 standingPose(const PlacedVehicle& placed) {
  const double height_m = placed.scenario.quadrotor.gear_height_m - Quadrotor::kGearSag_m;
  return placed.T_world_map * common::Pose3{Eigen::Quaterniond::Identity(), {0.0, 0.0, height_m}};
}

}  // namespace

VehicleModel::VehicleModel(PlacedVehicle placed, const WorldModel& world, const RayCaster& rays)
    : placed_(std::move(placed)),
      faults_(placed_.scenario.faults),
      quadrotor_(placed_.scenario.vehicle, placed_.scenario.quadrotor, standingPose(placed_),
                 placed_.scenario.battery_remaining),
      autopilot_(placed_.scenario.vehicle, placed_.scenario.quadrotor, placed_.scenario.autopilot),
      referee_(world, rays, placed_.scenario),
      sensors_(placed_.scenario, faults_, placed_.stream_seed, world),
      setpoint_link_(placed_.scenario.sensors.command_link, placed_.stream_seed),
      hands_(placed_.scenario.hands.begin(), placed_.scenario.hands.end()) {
  referee_.lookDown(quadrotor_.state());
  updateTruth(Time());
}

Actor VehicleModel::hull() const {
  const Eigen::Vector3d& at = quadrotor_.state().T_world_body.position_m;
  const common::VehicleConfig& sheet = placed_.scenario.vehicle;
  const double middle_m = at.z() - fallen_m_, half_height_m = 0.5 * sheet.hull_height_m;
  return {.position_world_m = at.head<2>(),
          .radius_m = sheet.hullRadius_m(),
          .bottom_m = middle_m - half_height_m,
          .top_m = middle_m + half_height_m,
          .color = kHullColor};
}

WalkedAround VehicleModel::asWalkedAround() const {
  const QuadrotorState& state = quadrotor_.state();
  return {state.T_world_body.position_m, state.velocity_world_m_s, !state.standing && !truth_.crashed};
}

void VehicleModel::begin(const std::vector<Actor>& around) { sensors_.begin(quadrotor_.state(), around); }

void VehicleModel::fly(Time now, std::uint64_t step, const Eigen::Vector3d& wind_world_m_s) {
  stopped_ = truth_.crashed;
  if (stopped_) {
    fall();
    return;
  }
  while (const auto arrived = setpoint_link_.next(now)) autopilot_.receive(arrived->setpoint, arrived->time);
  if (step % kStepsPerAutopilotTick == 0) stepAutopilot(now, step / kStepsPerAutopilotTick);
  push(now);
  for (Hand& hand : hands_) hand.lead(now, quadrotor_);
  before_step_ = quadrotor_.state();
  quadrotor_.step(throttles_, wind_world_m_s, referee_.floor_world_m(), kStep_s);
}

void VehicleModel::stepAutopilot(Time now, std::uint64_t tick) {
  constexpr double kTick_s = kStep_s * kStepsPerAutopilotTick;
  const AttitudeMeasurement measured = sensors_.attitude(tick, quadrotor_.state(), quadrotor_.battery(), kTick_s);
  const PilotConfig* sticks = sensors_.sticks(now);
  if (sticks != nullptr && sticks->takes_over) {
    const Scenario& scenario = placed_.scenario;
    const double max_tilt_rad = scenario.vehicle.max_tilt_deg * std::numbers::pi / 180.0;
    autopilot_.fly({now, sticks->thrust > 0.0, sticks->roll * max_tilt_rad, sticks->pitch * max_tilt_rad,
                    sticks->yaw_rate * scenario.autopilot.max_yaw_rate_rad_s, sticks->thrust},
                   now);
  }
  throttles_ = autopilot_.tick(now, measured, kTick_s);
}

void VehicleModel::push(Time now) {
  for (const PushConfig& push : placed_.scenario.pushes)
    if (now == Time() + kStep * std::llround(push.time_s / kStep_s))
      quadrotor_.push({push.x_n_s, push.y_n_s, push.z_n_s});
}

// The truth stays at the contact; only the hull that other vehicles can hit falls.
void VehicleModel::fall() {
  const double height_m = quadrotor_.state().T_world_body.position_m.z() - 0.5 * placed_.scenario.vehicle.hull_height_m;
  const double room_m = std::max(0.0, height_m - referee_.floor_world_m());
  falling_m_s_ += common::kGravity_m_s2 * kStep_s;
  fallen_m_ = std::min(room_m, fallen_m_ + falling_m_s_ * kStep_s);
}

void VehicleModel::judge(Time now, std::uint64_t step, std::span<const Walker> walkers, std::span<const Door> doors) {
  if (stopped_) return;
  referee_.judgeTouchDown(now, before_step_, quadrotor_.state(), truth_);
  if (step % kStepsPerLook == 0) {
    referee_.lookDown(quadrotor_.state());
    referee_.judgeContacts(now, quadrotor_.state(), walkers, doors, sensors_.seenShapes(), truth_);
    feelWall();
    truth_.closed_doors.clear();
    for (const Door& door : doors)
      if (door.isClosed()) truth_.closed_doors.push_back(door.actor());
  }
  updateTruth(now);
}

void VehicleModel::feelWall() {
  const Clearance& wall = referee_.clearance();
  const bool near = wall.shape != Hit::kNothing;
  const Eigen::Vector2d towards = (wall.point_world_m - quadrotor_.state().T_world_body.position_m).head<2>();
  quadrotor_.feelWall(near ? towards : Eigen::Vector2d::Zero(), wall.distance_m);
}

void VehicleModel::judgeMeeting(Time now, double gap_m, const VehicleModel& other) {
  if (stopped_) return;
  referee_.judgeMeeting(now, quadrotor_.state(), gap_m, other.hull(), other.placed().name, truth_);
}

void VehicleModel::measure(Time now, const std::vector<Actor>& around, const RayCaster& rays) {
  if (stopped_) return;
  sensors_.step(now, quadrotor_.state(), quadrotor_.battery(), around, rays);
}

void VehicleModel::updateTruth(Time now) {
  const QuadrotorState& state = quadrotor_.state();
  truth_.stamp = now;
  truth_.T_world_body = state.T_world_body;
  truth_.velocity_world_m_s = state.velocity_world_m_s;
  truth_.airborne = !state.standing;
  truth_.battery_remaining = quadrotor_.battery().remaining();
  faults_.step(now, state.T_world_body.position_m.head<2>());
  truth_.faulty = faults_.anyActive(now);
  truth_.failed_sensor = faults_.failedForFlight(now);
  truth_.lost_cells = faults_.lostCells(now);
  quadrotor_.loseCells(truth_.lost_cells);
}

double gapBetween_m(const Actor& a, const Actor& b) {
  if (a.bottom_m > b.top_m || b.bottom_m > a.top_m) return std::numeric_limits<double>::infinity();
  return std::max(0.0, (a.position_world_m - b.position_world_m).norm() - (a.radius_m + b.radius_m));
}

}  // namespace swiftlet::simulation
