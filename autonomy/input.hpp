// All that the autonomy ever learns comes as one of these, one after the other. The same inputs in the same order give
// the same setpoints, events and map, bit for bit.
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

/// The 100 Hz timer (common::kControlPeriod): asks for a setpoint.
struct Tick {
  common::Time now;
};

/// An immutable value; scans and camera frames are shared, not copied.
using Input = std::variant<common::SensorEvent, CommandInput, common::JobDelivery, Tick>;

/// When it is given to the autonomy: a sensor event when it arrived, a job when it was delivered.
common::Time timeOf(const Input& input);

}  // namespace swiftlet::autonomy
