#include "autonomy/senses.hpp"

#include <utility>
#include <variant>

#include <fmt/format.h>

#include "autonomy/autonomy_config.hpp"

namespace swiftlet::autonomy {

using common::Time;

Senses::Senses(const AutonomyConfig& config, const AutonomySetup& setup, common::EventLog& log)
    : behavior_period_s_(1.0 / kBehaviorRate_hz),
      log_(log),
      estimator_(config.estimator, setup.laser, setup.vehicle, setup.given, *setup.jobs, log, setup.camera,
                 setup.vertical_laser),
      stamps_(log),
      scans_(config.scans, 1.0 / setup.laser.rate_hz),
      scan_watch_(1.0 / setup.laser.rate_hz, log),
      inertial_(config.control.position.attitude_lag_s, log),
      given_map_(setup.given, log),
      battery_check_(log),
      consumption_(config.energy, setup.vehicle, control::ThrustTable::kVoltageExponent) {}

bool Senses::sense(const common::SensorEvent& event) {
  if (const auto* scan = std::get_if<std::shared_ptr<const common::LaserScan>>(&event)) {
    const auto timed = scan_watch_.take(*scan);
    if (timed == nullptr || !stamps_.accepts(timed)) return false;
    take(timed);
    return true;
  }
  if (!stamps_.accepts(event)) return false;
  if (const auto* imu = std::get_if<common::ImuSample>(&event)) {
    if (const auto sample = inertial_.take(estimator_.withAttitude(*imu))) estimator_.addImu(*sample);
  } else if (const auto* frame = std::get_if<std::shared_ptr<const common::RgbdFrame>>(&event)) {
    if (estimator_.addFrame(*frame)) frames_.push_back({*frame, estimator_.state()});
  } else if (const auto* sweep = std::get_if<std::shared_ptr<const common::VerticalScan>>(&event)) {
    estimator_.addSweep(*sweep);
  } else if (const auto* battery = std::get_if<common::BatterySample>(&event)) {
    take(*battery);
  }
  return true;
}

/// The first scan that is left out leaves an event, all of them a figure of the run.
void Senses::take(const std::shared_ptr<const common::LaserScan>& scan) {
  if (scans_.add(scan) || scans_.lateScans() > 1) return;
  const common::Stamps& stamps = scan->stamps;
  log_.warn(stamps.arrived, "laser", "late scan rejected",
            fmt::format("{:.0f} ms after it was measured, {:.0f} ms behind a later one; further ones are only counted",
                        1e3 * (stamps.arrived - stamps.measured).seconds(),
                        1e3 * (scans_.lastMeasured() - stamps.measured).seconds()));
}

void Senses::take(const common::BatterySample& sample) {
  if (!battery_check_.accepts(sample)) return;
  battery_v_ = sample.voltage_v;
  consumption_.add(sample, airborne_, thrust_margin_, estimator_.state().velocity_odom_m_s.head<2>().norm());
}

void Senses::hear(const Feedback& feedback) {
  airborne_ = feedback.airborne;
  thrust_margin_ = feedback.thrust_margin;
  inertial_.flown(feedback.setpoint, feedback.inertial);
  if (feedback.path_speed_m_s) consumption_.followed(*feedback.path_speed_m_s, common::kControlPeriod.seconds());
  estimator_.hear(feedback);
  for (const GivenMapOrder& order : feedback.given_map)
    if (order.load != nullptr) given_map_.load(*order.load);
}

Percept Senses::sense(Time now) {
  while (const auto sample = inertial_.predicted(now)) estimator_.addImu(*sample, true);
  std::vector<SeenScan> scans = processScans(now);
  estimator_.updateMap3d(now, common::PlaceNames::in(given_map_.T_map_given()));
  Percept percept = this->percept(now);
  percept.scans = std::move(scans);
  percept.frames = std::exchange(frames_, {});
  for (const SeenScan& seen : percept.scans)
    if (seen.outcome.raw_height) percept.raw_height = seen.outcome.raw_height;
  if (!last_behaviors_ || (now - *last_behaviors_).seconds() >= behavior_period_s_ - 1e-6) {
    last_behaviors_ = now;
    percept.must_land = inertial_.mustLandFor(now);
    percept.around = surroundings(now, percept.state);
  }
  return percept;
}

Percept Senses::start(const Feedback& standing) {
  thrust_margin_ = standing.thrust_margin;
  Percept percept = this->percept(Time{});
  percept.around = surroundings(percept.now, percept.state);
  return percept;
}

std::vector<SeenScan> Senses::processScans(Time now) {
  std::vector<SeenScan> seen;
  while (const auto scan = scans_.take(now)) {
    if (auto outcome = estimator_.addScan(*scan, now))
      seen.push_back({std::move(*outcome), estimator_.state(), estimator_.people().obstacles()});
  }
  return seen;
}

Percept Senses::percept(Time now) {
  Percept percept;
  percept.now = now;
  percept.state = estimator_.state();
  percept.drift_m = estimator_.drift_m();
  percept.battery_v = battery_v_;
  percept.ready = estimator_.ready();
  percept.fusion_diverged = estimator_.health().status == perception::FusionStatus::kDiverged;
  percept.inertial_fault = inertial_.fault(now);
  percept.inertial_contradicted = inertial_.contradicted();
  const BodyMotion motion = estimator_.motion();
  percept.acceleration_odom_m_s2 = motion.acceleration_odom_m_s2;
  percept.horizon_offset_rad = motion.horizon_offset_rad;
  percept.estimator = &estimator_;
  percept.consumption = &consumption_;
  return percept;
}

Surroundings Senses::surroundings(Time now, const common::VehicleState& state) {
  Surroundings around;
  EstimatedMaps maps = estimator_.maps();
  given_map_.update(now, state.T_map_body_planar(), state.T_map_odom, maps.localization, maps.grid);
  around.grid = given_map_.grid();
  around.grid_for_paths = given_map_.gridForPaths();
  around.flown = given_map_.flown();
  around.given = given_map_.given();
  around.T_map_given = given_map_.T_map_given();
  around.localization = std::move(maps.localization);
  around.levels = std::move(maps.levels);
  around.map3d = std::move(maps.map3d);
  around.targets = std::move(maps.targets);
  around.objects = std::move(maps.objects);
  return around;
}

}  // namespace swiftlet::autonomy
