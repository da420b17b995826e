// The files that a command line names, distinguished by their use: a mission is no trial, and a world no map.
#pragma once

#include <string>
#include <string_view>

namespace swiftlet::flight {

/// The file of a mission, as common::findData finds it. Throws common::InputError also for a file of another kind.
std::string findMission(const std::string& name);
/// The file of a trial, or the folder of several, found and judged likewise.
std::string findTrial(const std::string& name);
/// Throws common::InputError if a file shows by its name or its keys that it is not `what`: "a world", "a map" or
/// "a profile".
void refuseOtherKind(const std::string& file, std::string_view what);

}  // namespace swiftlet::flight
