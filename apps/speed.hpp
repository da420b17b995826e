// --speed: how fast the simulator is paced.
#pragma once

#include <string>

namespace swiftlet::apps {

/// "max" is 0 (as fast as the machine can); a number is that many times real time. Throws common::InputError otherwise.
double parseSpeed(const std::string& text);

}  // namespace swiftlet::apps
