#include "simulation/fault_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swiftlet::simulation {

using common::Time;

namespace {

/// The prediction of a filter bridges shorter faults, and that of one with inertial samples those of the laser.
constexpr double kLasting_s = 1.0, kLaserLasting_s = 3.0;
/// Less than twice the delay of the slowest shipped nature, 0.2 s.
constexpr double kBridged_s = 0.4;
/// Stamps that are off by less move a scan by at most 5 cm at 0.5 m/s and 6 deg at 1 rad/s.
constexpr double kClockOff_s = 0.1;
/// Most of what a laser of 270 deg sees is left beside a narrower sector.
constexpr double kNarrow_deg = 90.0;

/// Whether the vehicle lacks what the sensor is for while the fault lasts.
bool takesAway(const FaultConfig& fault, double lasts_s) {
  switch (fault.kind) {
    case FaultKind::kLate:  // The charge changes slowly.
      return fault.sensor != Sensor::kBattery && fault.late_s >= kBridged_s;
    case FaultKind::kClockJump:
      return fault.sensor != Sensor::kBattery && std::abs(fault.jump_s) >= kClockOff_s;
    case FaultKind::kClockDrift:
      return fault.sensor != Sensor::kBattery && std::abs(fault.drift_s_s) * lasts_s >= kClockOff_s;
    case FaultKind::kBlocked:
      return fault.to_deg - fault.from_deg >= kNarrow_deg;
    default:
      return true;
  }
}

Time endOf(const FaultConfig& fault, Time begin) {
  constexpr double kNever_s = 1e9;
  if (isOfBattery(fault.kind)) return Time::fromSeconds(kNever_s);
  return fault.isTriggered() ? begin + common::Duration::fromSeconds(fault.lasts_s) : Time::fromSeconds(fault.to_s);
}

}  // namespace

FaultSchedule::FaultSchedule(std::vector<FaultConfig> faults) {
  for (FaultConfig& fault : faults) {
    Scheduled scheduled{std::move(fault), {}, {}};
    if (scheduled.config.isTriggered()) {
      any_waits_ = true;
    } else {
      scheduled.begin = Time::fromSeconds(scheduled.config.from_s);
      scheduled.end = endOf(scheduled.config, *scheduled.begin);
    }
    faults_.push_back(std::move(scheduled));
  }
}

void FaultSchedule::step(Time now, const Eigen::Vector2d& position_world_m) {
  if (!any_waits_) return;
  any_waits_ = false;
  for (Scheduled& fault : faults_) {
    if (fault.begin) continue;
    if (isDue(fault.config, now, position_world_m)) {
      fault.begin = now;
      fault.end = endOf(fault.config, now);
    } else {
      any_waits_ = true;
    }
  }
}

bool FaultSchedule::isDue(const FaultConfig& fault, Time now, const Eigen::Vector2d& position_world_m) const {
  if (now.seconds() < fault.from_s) return false;
  if (!fault.place_world_m.empty()) {
    const Eigen::Vector2d place(fault.place_world_m[0], fault.place_world_m[1]);
    if ((position_world_m - place).norm() > fault.within_m) return false;
  }
  return fault.phase.empty() || std::any_of(phase_.begin(), phase_.end(),
                                            [&](const std::string& word) { return word.starts_with(fault.phase); });
}

std::optional<ActiveFault> FaultSchedule::of(Sensor sensor, Time time) const {
  for (const Scheduled& fault : faults_)
    if (fault.config.sensor == sensor && !isOfBattery(fault.config.kind) && fault.activeAt(time))
      return ActiveFault{fault.config, *fault.begin};
  return std::nullopt;
}

bool FaultSchedule::anyActive(Time time) const {
  return std::any_of(faults_.begin(), faults_.end(), [time](const Scheduled& fault) { return fault.activeAt(time); });
}

int FaultSchedule::lostCells(Time time) const {
  return static_cast<int>(std::count_if(faults_.begin(), faults_.end(), [time](const Scheduled& fault) {
    return isOfBattery(fault.config.kind) && fault.activeAt(time);
  }));
}

std::optional<Sensor> FaultSchedule::failedForFlight(Time time) const {
  for (const Sensor sensor : {Sensor::kImu, Sensor::kLaser, Sensor::kBattery})
    for (const Scheduled& fault : faults_) {
      if (fault.config.sensor != sensor || !fault.activeAt(time)) continue;
      const double lasts_s = (*fault.end - *fault.begin).seconds();
      const bool lasting = sensor == Sensor::kLaser ? lasts_s > kLaserLasting_s : lasts_s >= kLasting_s;
      if (lasting && takesAway(fault.config, lasts_s)) return sensor;
    }
  return std::nullopt;
}

}  // namespace swiftlet::simulation
