#include "simulation/flight.hpp"

#include <cmath>
#include <numbers>

namespace swiftlet::simulation {
namespace {

using common::Duration;
using common::Time;

constexpr Duration kStep = Duration::fromMilliseconds(1);
constexpr double kStep_s = 0.001;
constexpr std::uint64_t kStepsPerAutopilotTick = 2;  // 500 Hz.
constexpr std::uint64_t kStepsPerLook = 10;          // 100 Hz: referee and wind.

common::Pose3 standingPose(const Realization& realization) {
  const double height_m = realization.scenario.quadrotor.gear_height_m - Quadrotor::kGearSag_m;
  return realization.T_world_map * common::Pose3{Eigen::Quaterniond::Identity(), {0.0, 0.0, height_m}};
}

}  // namespace

Flight::Flight(Realization realization)
    : realization_(std::move(realization)),
      rays_(realization_.world),
      quadrotor_(realization_.scenario.vehicle, realization_.scenario.quadrotor, standingPose(realization_),
                 realization_.scenario.battery_remaining),
      autopilot_(realization_.scenario.vehicle, realization_.scenario.quadrotor, realization_.scenario.autopilot),
      wind_(realization_.scenario.wind, realization_.scenario.seed),
      referee_(realization_.world, rays_, realization_.scenario),
      sensors_(realization_.scenario, realization_.world),
      command_link_(realization_.scenario.sensors.command_link, realization_.scenario.seed, "command") {
  const Scenario& scenario = realization_.scenario;
  for (std::size_t i = 0; i < scenario.walkers.size(); ++i)
    walkers_.emplace_back(scenario.walkers[i], scenario.seed, i, realization_.T_world_map.position_m.z(),
                          scenario.vehicle.hullRadius_m(), rays_);
  referee_.lookDown(quadrotor_.state());
  sensors_.begin(quadrotor_.state(), actors_);
  updateTruth();
}

bool Flight::advanceTo(Time time, std::vector<common::SensorEvent>& events) {
  while (!truth_.crashed && stepped_ + kStep <= time) step();
  now_ = truth_.crashed ? stepped_ : std::max(now_, time);
  sensors_.take(now_, events);
  return !truth_.crashed;
}

void Flight::apply(const common::Setpoint& setpoint) {
  if (const auto arrival = command_link_.arrival(commands_++, now_))
    commands_under_way_.emplace_back(*arrival, setpoint);
}

void Flight::step() {
  while (!commands_under_way_.empty() && commands_under_way_.front().first <= stepped_) {
    autopilot_.receive(commands_under_way_.front().second, commands_under_way_.front().first);
    commands_under_way_.pop_front();
  }
  if (step_ % kStepsPerAutopilotTick == 0) stepAutopilot();
  if (step_ % kStepsPerLook == 0) wind_.step(step_ / kStepsPerLook, kStep_s * kStepsPerLook);
  push();

  const QuadrotorState before = quadrotor_.state();
  quadrotor_.step(throttles_, wind_.velocity_world_m_s(), referee_.floor_world_m(), kStep_s);
  stepped_ += kStep;
  ++step_;
  stepWalkers();

  referee_.judgeTouchDown(stepped_, before, quadrotor_.state(), truth_);
  if (step_ % kStepsPerLook == 0) {
    referee_.lookDown(quadrotor_.state());
    referee_.judgeContacts(stepped_, quadrotor_.state(), walkers_, truth_);
  }
  updateTruth();
  sensors_.step(stepped_, quadrotor_.state(), quadrotor_.battery(), actors_, rays_);
}

void Flight::stepAutopilot() {
  constexpr double kTick_s = kStep_s * kStepsPerAutopilotTick;
  const AttitudeMeasurement measured =
      sensors_.attitude(step_ / kStepsPerAutopilotTick, quadrotor_.state(), quadrotor_.battery(), kTick_s);
  const PilotConfig* sticks = sensors_.sticks(stepped_);
  if (sticks != nullptr && sticks->takes_over) {
    const double max_tilt_rad = realization_.scenario.vehicle.max_tilt_deg * std::numbers::pi / 180.0;
    autopilot_.receive({stepped_, sticks->thrust > 0.0, sticks->roll * max_tilt_rad, sticks->pitch * max_tilt_rad,
                        sticks->yaw_rate * realization_.scenario.autopilot.max_yaw_rate_rad_s, sticks->thrust},
                       stepped_);
  }
  throttles_ = autopilot_.tick(stepped_, measured, kTick_s);
}

void Flight::push() {
  for (const PushConfig& push : realization_.scenario.pushes)
    if (stepped_ == Time() + kStep * std::llround(push.time_s / kStep_s))
      quadrotor_.push({push.x_n_s, push.y_n_s, push.z_n_s});
}

void Flight::stepWalkers() {
  if (walkers_.empty()) return;
  const QuadrotorState& state = quadrotor_.state();
  const WalkedAround vehicle{state.T_world_body.position_m, state.velocity_world_m_s, !state.standing};
  actors_.clear();
  for (Walker& walker : walkers_) {
    walker.step(stepped_, vehicle, kStep_s);
    if (walker.actor()) actors_.push_back(*walker.actor());
  }
}

void Flight::updateTruth() {
  const QuadrotorState& state = quadrotor_.state();
  truth_.stamp = stepped_;
  truth_.T_world_body = state.T_world_body;
  truth_.velocity_world_m_s = state.velocity_world_m_s;
  truth_.airborne = !state.standing;
}

}  // namespace swiftlet::simulation
