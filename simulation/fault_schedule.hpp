// When the faults of a vehicle are active. Those with a place or a phase begin when it first comes there, and last
// their time from then on; each begins once.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/time.hpp"
#include "simulation/fault_config.hpp"

namespace swiftlet::simulation {

struct ActiveFault {
  const FaultConfig& config;  ///< Of the schedule.
  common::Time begin;
};

class FaultSchedule {
 public:
  explicit FaultSchedule(std::vector<FaultConfig> faults);

  /// The observer's state of the flight from now on: its state, the mission's phase, the running behaviours.
  void tellPhase(std::vector<std::string> words) { phase_ = std::move(words); }
  /// Call at each step, in the order of time.
  void step(common::Time now, const Eigen::Vector2d& position_world_m);

  /// The first fault of the sensor's measurements that is active at this time.
  std::optional<ActiveFault> of(Sensor sensor, common::Time time) const;
  bool anyActive(common::Time time) const;
  /// How many cells the battery has lost by this time.
  int lostCells(common::Time time) const;
  /// The sensor without which no vehicle flies on: the IMU, the laser or the battery's, if one of their faults that
  /// lasts for a second, of the laser for more than three, is active and takes away what the sensor is for. Delays
  /// below 0.4 s, clocks that go wrong by less than 0.1 s and a blocked sector narrower than 90 deg do not count; a
  /// lost cell does.
  std::optional<Sensor> failedForFlight(common::Time time) const;

 private:
  struct Scheduled {
    FaultConfig config;
    std::optional<common::Time> begin, end;  ///< nullopt: its place or phase has not come.

    bool activeAt(common::Time time) const { return begin && time >= *begin && time < *end; }
  };
  bool isDue(const FaultConfig& fault, common::Time now, const Eigen::Vector2d& position_world_m) const;

  std::vector<Scheduled> faults_;
  std::vector<std::string> phase_;
  bool any_waits_ = false;
};

}  // namespace swiftlet::simulation
