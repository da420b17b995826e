#include "simulation/sensors/sensor_suite.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "common/random.hpp"

namespace swiftlet::simulation {

using common::Time;

namespace {

/// A track begins this long before it is needed: more than a physics step, so that it can be interpolated.
constexpr auto kTrackMargin = common::Duration::fromMilliseconds(2);

}  // namespace

SensorSuite::SensorSuite(const Scenario& scenario, const FaultSchedule& faults, std::uint64_t seed,
                         const WorldModel& world)
    : scenario_(scenario),
      world_(world),
      seed_(seed),
      inertial_(scenario.sensors.imu, scenario.vehicle.max_thrust_n, seed),
      laser_{LaserScanner(scenario.laser, scenario.sensors.laser_errors, world, seed), Clock(scenario.laser.rate_hz)},
      fuel_gauge_(scenario.sensors.fuel_gauge, scenario.battery_remaining),
      queue_(scenario, faults, seed),
      imu_clock_(scenario.sensors.imu.rate_hz),
      battery_clock_(scenario.sensors.battery_rate_hz),
      pilot_clock_(scenario.sensors.pilot_rate_hz),
      camera_clock_(scenario.sensors.camera.rate_hz),
      rgbd_clock_(scenario.rgbd_camera.value_or(common::RgbdCameraConfig()).rate_hz) {
  if (scenario.rgbd_camera) rgbd_.emplace(*scenario.rgbd_camera, scenario.sensors.rgbd_errors, world, seed);
  if (const auto& laser = scenario.vertical_laser) {
    // Streams of its own: the same noise as that of the first laser would be that of one device.
    const std::uint64_t own_seed = common::RandomStream(seed, "vertical laser", 0).bits();
    vertical_laser_.emplace(
        Sweeper{LaserScanner(*laser, scenario.sensors.vertical_laser_errors, world, own_seed), Clock(laser->rate_hz)});
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
  laser_.track.assign(1, start);
  if (vertical_laser_) vertical_laser_->track.assign(1, start);
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
  stepLaser<common::LaserScan>(laser_, Sensor::kLaser, moment, rays);
  if (vertical_laser_) stepLaser<common::VerticalScan>(*vertical_laser_, Sensor::kVerticalLaser, moment, rays);
  stepSlow(now, battery);
  stepCamera(now, state, actors, rays);
  stepRgbd(now, state, actors, rays);
}

template <typename Scan>
void SensorSuite::stepLaser(Sweeper& laser, Sensor sensor, const Moment& moment, const RayCaster& rays) {
  auto& [scanner, clock, track] = laser;
  track.push_back(moment);
  const Time start = clock.next(), end = start + scanner.sweep();
  if (moment.time < end) return;
  auto scan = std::make_shared<Scan>(Scan{scanner.scan(clock.frame, start, track, rays)});
  // The sweep ended between two steps. Nothing arrives before it was computed.
  queue_.send(sensor, clock.frame++, moment.time, std::shared_ptr<const Scan>(std::move(scan)));
  const Time next = clock.next();
  const auto first_needed =
      std::find_if(track.begin(), track.end() - 1, [next](const Moment& at) { return at.time > next; });
  track.erase(track.begin(), first_needed == track.begin() ? first_needed : first_needed - 1);
}

void SensorSuite::stepCamera(Time now, const QuadrotorState& state, const std::vector<Actor>& actors,
                             const RayCaster& rays) {
  if (!camera_clock_.due(now)) return;
  const std::uint64_t number = camera_clock_.frame++;
  if (!camera_wanted_) return;
  if (!camera_) camera_.emplace(scenario_.sensors.camera, world_, seed_);
  auto frame = std::make_shared<common::CameraFrame>();
  frame->stamps.measured = now;
  frame->image = camera_->render(number, state.T_world_body, actors, rays);
  queue_.send(Sensor::kCamera, number, now, std::shared_ptr<const common::CameraFrame>(std::move(frame)));
}

// A frame is made when the exposure of its last row has ended; until then the vehicle's track is kept.
void SensorSuite::stepRgbd(Time now, const QuadrotorState& state, const std::vector<Actor>& actors,
                           const RayCaster& rays) {
  if (!rgbd_) return;
  const auto begin = [this] { return rgbd_clock_.next() - rgbd_->before() - kTrackMargin; };
  if (now >= begin()) rgbd_track_.push_back({now, state.T_world_body, actors});
  if (now < rgbd_clock_.next() + rgbd_->after()) return;
  const std::uint64_t number = rgbd_clock_.frame;
  auto frame = std::make_shared<common::RgbdFrame>(rgbd_->frame(number, rgbd_clock_.next(), rgbd_track_, rays));
  ++rgbd_clock_.frame;
  queue_.send(Sensor::kRgbd, number, now, std::shared_ptr<const common::RgbdFrame>(std::move(frame)));
  std::erase_if(rgbd_track_, [next = begin()](const Moment& moment) { return moment.time < next; });
}

void SensorSuite::stepSlow(Time now, const Battery& battery) {
  if (battery_clock_.due(now)) {
    common::RandomStream random(seed_, "battery", battery_clock_.frame);
    common::BatterySample sample;
    sample.stamps.measured = now;
    sample.voltage_v = battery.voltage_v() + random.gaussian(scenario_.sensors.battery_noise_v);
    sample.remaining = fuel_gauge_.remaining(battery);
    sample.current_a = fuel_gauge_.current_a(battery);
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
