// --start: where the vehicle stands in the world.
#pragma once

#include <string>

#include "simulation/scenario.hpp"

namespace swiftlet::apps {

/// "x;y", "x;y;yaw" or "x;y;z;yaw" in the world's frame, metres and degrees. Throws common::InputError otherwise.
simulation::StartConfig parseStart(const std::string& text);

}  // namespace swiftlet::apps
