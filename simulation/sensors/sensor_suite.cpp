#include "simulation/sensors/sensor_suite.hpp"

#include "common/random.hpp"
#include "simulation/sensors/fuel_gauge.hpp"

namespace swiftlet::simulation {

using common::Time;

SensorSuite::SensorSuite(const Scenario& scenario, const FaultSchedule& faults, std::uint64_t seed,
                         const WorldModel& world)
    : scenario_(scenario),
      seed_(seed),
      inertial_(scenario.sensors.imu, scenario.vehicle, seed),
      laser_(Sensor::kLaser, scenario.laser.rate_hz,
             LaserScanner(scenario.laser, scenario.sensors.laser_errors, world, seed)),
      camera_(scenario.sensors.camera, world, seed),
      queue_(scenario, faults, seed),
      imu_clock_(scenario.sensors.imu.rate_hz),
      battery_clock_(scenario.sensors.battery_rate_hz),
      pilot_clock_(scenario.sensors.pilot_rate_hz) {
  if (const auto& camera = scenario.rgbd_camera)
    rgbd_.emplace(camera->rate_hz, RgbdCamera(*camera, scenario.sensors.rgbd_errors, world, seed));
  if (const auto& laser = scenario.vertical_laser) {
    // Streams of its own: the same noise as that of the first laser would be that of one device.
    const std::uint64_t own_seed = common::RandomStream(seed, "vertical laser", 0).bits();
    vertical_laser_.emplace(Sensor::kVerticalLaser, laser->rate_hz,
                            LaserScanner(*laser, scenario.sensors.vertical_laser_errors, world, own_seed));
  }
  imu_clock_.frame = 1;  // The first sample is the mean of the first period.
}

AttitudeMeasurement SensorSuite::attitude(std::uint64_t tick, const QuadrotorState& state, const Battery& battery,
                                          double step_s) {
  AttitudeMeasurement measured = inertial_.attitude(tick, state, step_s);
  measured.battery_voltage_v = battery.voltage_v();
  return measured;
}

void SensorSuite::begin(const QuadrotorState& state, const std::vector<Actor>& actors) {
  const Moment start{Time(), state.T_world_body, actors};
  laser_.begin(start);
  if (vertical_laser_) vertical_laser_->begin(start);
}

void SensorSuite::step(Time now, const QuadrotorState& state, const Battery& battery, const std::vector<Actor>& actors,
                       const RayCaster& rays) {
  inertial_.feel(state);
  if (imu_clock_.due(now)) {
    common::ImuSample sample = inertial_.sample(imu_clock_.frame, state);
    sample.stamps.measured = now;
    queue_.send(Sensor::kImu, imu_clock_.frame++, now, sample);
  }
  const Moment moment{now, state.T_world_body, actors};
  laser_.step(moment, rays, queue_);
  if (vertical_laser_) vertical_laser_->step(moment, rays, queue_);
  stepSlow(now, battery);
  camera_.step(moment, rays, queue_);
  if (rgbd_) rgbd_->step(moment, rays, queue_);
}

void SensorSuite::stepSlow(Time now, const Battery& battery) {
  if (battery_clock_.due(now)) {
    common::RandomStream random(seed_, "battery", battery_clock_.frame);
    common::BatterySample sample;
    sample.stamps.measured = now;
    sample.voltage_v = battery.voltage_v() + random.gaussian(scenario_.sensors.battery_noise_v);
    const FuelGaugeConfig& gauge = scenario_.sensors.fuel_gauge;
    sample.remaining = gaugedCharge(gauge, scenario_.battery_remaining, battery);
    sample.current_a = gaugedCurrent_a(gauge, battery);
    queue_.send(Sensor::kBattery, battery_clock_.frame++, now, sample);
  }
  const PilotConfig* stick = sticks(now);
  if (pilot_clock_.due(now)) {
    const std::uint64_t number = pilot_clock_.frame++;
    if (stick == nullptr) return;
    queue_.send(
        Sensor::kPilot, number, now,
        common::PilotSample{{now, now}, stick->roll, stick->pitch, stick->yaw_rate, stick->thrust, stick->takes_over});
  }
}

const PilotConfig* SensorSuite::sticks(Time now) const {
  const PilotConfig* present = nullptr;
  for (const PilotConfig& entry : scenario_.pilot)
    if (entry.time_s <= now.seconds()) present = &entry;
  return present;
}

}  // namespace swiftlet::simulation
