// What a fault does to one measurement.
#pragma once

#include <optional>

#include "common/sensor_event.hpp"
#include "common/vehicle_config.hpp"
#include "simulation/fault_schedule.hpp"

namespace swiftlet::simulation {

/// The measurement with other stamps.
common::SensorEvent restamped(common::SensorEvent event, const common::Stamps& stamps);

/// The measurement as it arrives, or nullopt. The event's kind belongs to the fault's sensor, and its stamps
/// are set. `last_good` is the sensor's last measurement without a fault, if there was one.
std::optional<common::SensorEvent> withFault(const ActiveFault& active, const common::SensorEvent& event,
                                             const std::optional<common::SensorEvent>& last_good,
                                             const common::LaserConfig& laser);

}  // namespace swiftlet::simulation
