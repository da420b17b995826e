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
#include "simulation/sensors/camera.hpp"
#include "simulation/sensors/event_queue.hpp"
#include "simulation/sensors/fuel_gauge.hpp"
#include "simulation/sensors/inertial_unit.hpp"
#include "simulation/sensors/laser_scanner.hpp"
#include "simulation/sensors/rgbd_camera.hpp"
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
  void setCameraConsumer(bool wanted) { camera_wanted_ = wanted; }

  /// As LaserScanner::seen().
  const std::vector<bool>& seenShapes() const { return laser_.scanner.seen(); }
  /// The pilot's sticks now; null without a remote control.
  const PilotConfig* sticks(common::Time now) const;

 private:
  /// Counts the periods of a sensor; frame number `frame` is due at next().
  struct Clock {
    explicit Clock(double rate_hz) : period(common::Duration::fromSeconds(1.0 / rate_hz)) {}
    common::Duration period;
    std::uint64_t frame = 0;
    common::Time next() const { return common::Time() + period * static_cast<std::int64_t>(frame); }
    bool due(common::Time now) const { return now >= next(); }
  };

  /// A laser with the track since the start of its present sweep.
  struct Sweeper {
    LaserScanner scanner;
    Clock clock;
    std::vector<Moment> track = {};
  };
  /// `Scan` is the type of its measurements.
  template <typename Scan>
  void stepLaser(Sweeper& laser, Sensor sensor, const Moment& moment, const RayCaster& rays);
  void stepCamera(common::Time now, const QuadrotorState& state, const std::vector<Actor>& actors,
                  const RayCaster& rays);
  void stepRgbd(common::Time now, const QuadrotorState& state, const std::vector<Actor>& actors, const RayCaster& rays);
  void stepSlow(common::Time now, const Battery& battery);

  Scenario scenario_;
  const WorldModel& world_;
  std::uint64_t seed_;
  InertialUnit inertial_;
  Sweeper laser_;
  std::optional<Sweeper> vertical_laser_;
  std::optional<Camera> camera_;  ///< Made for the first frame that is wanted.
  std::optional<RgbdCamera> rgbd_;
  FuelGauge fuel_gauge_;
  EventQueue queue_;
  Clock imu_clock_, battery_clock_, pilot_clock_, camera_clock_, rgbd_clock_;
  std::vector<Moment> rgbd_track_;  ///< The track since the present frame of the RGB-D camera began to be exposed.
  bool camera_wanted_ = false;
};

}  // namespace swiftlet::simulation
