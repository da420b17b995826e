// All sensors of the vehicle with their clocks. Frames of the operator's camera are rendered only if they are consumed;
// this changes no other byte.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/sensor_event.hpp"
#include "simulation/fault_schedule.hpp"
#include "simulation/quadrotor.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/scenario.hpp"
#include "simulation/sensors/inertial_unit.hpp"
#include "simulation/sensors/sensor_streams.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

class SensorSuite {
 public:
  /// `seed` names the random streams of all sensors. Schedule and world must outlive it.
  SensorSuite(const Scenario& scenario, const FaultSchedule& faults, std::uint64_t seed, const WorldModel& world);

  /// What the autopilot measures at its tick number `tick`.
  AttitudeMeasurement attitude(std::uint64_t tick, const QuadrotorState& state, const Battery& battery, double step_s);

  /// Call it at time 0, before the first step.
  void begin(const QuadrotorState& state, const std::vector<Actor>& actors);

  /// Call it after each physics step. It makes the measurements that are due.
  void step(common::Time now, const QuadrotorState& state, const Battery& battery, const std::vector<Actor>& actors,
            const RayCaster& rays);

  void take(common::Time until, std::vector<common::SensorEvent>& events) { queue_.take(until, events); }
  void setCameraConsumer(bool wanted) { camera_.setWanted(wanted); }

  /// As LaserScanner::seen().
  const std::vector<bool>& seenShapes() const { return laser_.scanner().seen(); }
  /// The pilot's sticks now; null without a remote control.
  const PilotConfig* sticks(common::Time now) const;

 private:
  void stepSlow(common::Time now, const Battery& battery);

  Scenario scenario_;
  std::uint64_t seed_;
  InertialUnit inertial_;
  LaserStream laser_;
  std::optional<LaserStream> vertical_laser_;
  CameraStream camera_;
  std::optional<RgbdStream> rgbd_;
  EventQueue queue_;
  SensorClock imu_clock_, battery_clock_, pilot_clock_;
};

}  // namespace swiftlet::simulation
