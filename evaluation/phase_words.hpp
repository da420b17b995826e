// The words for what a vehicle does now, by which trials name windows of a flight.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swiftlet::common {
struct World;
}

namespace swiftlet::evaluation {

/// The flight's state ("taking off"), the mission's phase ("go to (3.00, -1.50)"), what the intent says ("detour: goes
/// nearer to look") and the names of the running behaviours ("GoHome").
std::vector<std::string> phaseWords(const common::World& world);

bool anyBeginsWith(const std::vector<std::string>& words, std::string_view text);

}  // namespace swiftlet::evaluation
