// What a fault does to the pictures of a camera.
#pragma once

#include <optional>

#include "common/sensor_event.hpp"
#include "simulation/fault_config.hpp"

namespace swiftlet::simulation {

/// The frame of either camera with that fault of its pictures; nullopt if the fault is of another kind.
std::optional<common::SensorEvent> withPictureFault(FaultKind kind, const common::SensorEvent& event);

}  // namespace swiftlet::simulation
