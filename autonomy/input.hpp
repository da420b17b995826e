// Everything that the autonomy receives is one of these inputs. The same inputs in the same order give the same
// setpoints, events and map, bit for bit.
#pragma once

#include <variant>

#include "common/command.hpp"
#include "common/jobs.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// An operator's command, with the time at which the loop took it.
struct CommandInput {
  common::OperatorCommand command;
  common::Time taken;
};

/// The 100 Hz timer (common::kControlPeriod): requests a setpoint.
struct Tick {
  common::Time now;
};

/// An immutable value; scans and camera frames are shared, not copied.
using Input = std::variant<common::SensorEvent, CommandInput, common::JobDelivery, Tick>;

/// The time when the autonomy receives the input: the arrival of a sensor event, the delivery of a job.
common::Time timeOf(const Input& input);

}  // namespace swiftlet::autonomy
