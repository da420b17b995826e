// One vehicle of the arena: physics, autopilot, battery, sensors, the link for its setpoints, and the referee of its
// hull. The arena moves it, step by step.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/sensor_event.hpp"
#include "common/vehicle.hpp"
#include "simulation/autopilot.hpp"
#include "simulation/doors.hpp"
#include "simulation/fault_schedule.hpp"
#include "simulation/hand.hpp"
#include "simulation/quadrotor.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/referee.hpp"
#include "simulation/sensors/sensor_suite.hpp"
#include "simulation/setpoint_link.hpp"
#include "simulation/truth.hpp"
#include "simulation/variation.hpp"
#include "simulation/walkers.hpp"

namespace swiftlet::simulation {

/// Period of a physics step.
inline constexpr common::Duration kStep = common::Duration::fromMilliseconds(1);
inline constexpr double kStep_s = 0.001;
/// Physics steps between two looks of the referee, and between two updates of the wind: 100 Hz.
inline constexpr std::uint64_t kStepsPerLook = 10;

class VehicleModel {
 public:
  /// World and rays must outlive it.
  VehicleModel(PlacedVehicle placed, const WorldModel& world, const RayCaster& rays);
  VehicleModel(const VehicleModel&) = delete;
  VehicleModel& operator=(const VehicleModel&) = delete;

  /// The scenario, name and start as drawn.
  const PlacedVehicle& placed() const { return placed_; }
  /// The truth. It stays at the contact after a crash.
  const Truth& truth() const { return truth_; }
  /// The hull that the rays of other vehicles hit. After a crash it falls to the floor and stays there.
  Actor hull() const;
  WalkedAround asWalkedAround() const;

  // One step of the arena, in this order. `around` is what its rays may hit besides the world.

  /// The sensors' first measurements, before any step.
  void begin(const std::vector<Actor>& around);
  /// Step number `step`, which begins at `now`: autopilot, pushes, hands and physics.
  void fly(common::Time now, std::uint64_t step, const Eigen::Vector3d& wind_world_m_s);
  /// At the end of step number `step`, at `now`: touch-downs, and contacts when a look is due.
  void judge(common::Time now, std::uint64_t step, std::span<const Walker> walkers, std::span<const Door> doors);
  /// The gap between its hull and that of another vehicle. At 0 they touch, which ends both flights.
  void judgeMeeting(common::Time now, double gap_m, const VehicleModel& other);
  void measure(common::Time now, const std::vector<Actor>& around, const RayCaster& rays);

  void take(common::Time until, std::vector<common::SensorEvent>& events) { sensors_.take(until, events); }
  /// Sends a setpoint at `now`; it arrives after the latency of the link.
  void apply(common::Time now, const common::Setpoint& setpoint) { setpoint_link_.send(now, setpoint); }
  /// As FaultSchedule::tellPhase().
  void tellPhase(std::vector<std::string> words) { faults_.tellPhase(std::move(words)); }
  void setCameraConsumer(bool wanted) { sensors_.setCameraConsumer(wanted); }

 private:
  void stepAutopilot(common::Time now, std::uint64_t tick);
  void push(common::Time now);
  void feelWall();
  void fall();
  void updateTruth(common::Time now);

  PlacedVehicle placed_;
  FaultSchedule faults_;
  Quadrotor quadrotor_;
  Autopilot autopilot_;
  Referee referee_;
  SensorSuite sensors_;
  SetpointLink setpoint_link_;
  std::vector<Hand> hands_;
  std::array<double, 4> throttles_{};
  QuadrotorState before_step_;
  Truth truth_;
  bool stopped_ = false;   ///< It had crashed before the present step.
  double fallen_m_ = 0.0;  ///< How far it has fallen since the crash.
  double falling_m_s_ = 0.0;
};

/// Horizontal distance between two upright cylinders, 0 if they touch, infinity if one is above the other.
double gapBetween_m(const Actor& a, const Actor& b);

}  // namespace swiftlet::simulation
