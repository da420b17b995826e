// Measurements on their links to the computer, with the configured faults applied.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/sensor_event.hpp"
#include "simulation/fault_schedule.hpp"
#include "simulation/scenario.hpp"
#include "simulation/sensors/link.hpp"

namespace swiftlet::simulation {

class EventQueue {
 public:
  /// `seed` names the random streams of the links. The schedule must outlive it.
  EventQueue(const Scenario& scenario, const FaultSchedule& faults, std::uint64_t seed);

  /// Sends measurement number `frame` of a sensor; its stamp `measured` is set.
  void send(Sensor sensor, std::uint64_t frame, common::Time ready, common::SensorEvent event);

  /// Removes and appends the measurements that have arrived by `until`, ordered by arrival, then by Sensor, then by
  /// frame.
  void take(common::Time until, std::vector<common::SensorEvent>& events);

 private:
  struct Entry {
    common::Time arrived;
    Sensor sensor;
    std::uint64_t frame;
    common::SensorEvent event;
  };

  const FaultSchedule& faults_;
  common::LaserConfig laser_;
  std::vector<Link> links_;  ///< One link per Sensor.
  std::array<std::optional<common::SensorEvent>, kSensorCount> last_good_;
  std::vector<Entry> under_way_;
};

}  // namespace swiftlet::simulation
