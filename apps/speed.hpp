// --speed: how fast the simulator is paced.
#pragma once

#include <string>

namespace swiftlet::apps {

/// "max" is 0 (as fast as possible); a number is that multiple of real time. Throws common::InputError otherwise.
double parseSpeed(const std::string& text);

}  // namespace swiftlet::apps
