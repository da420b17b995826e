// Notes for people where the coordinates of a cloud are probably not in metres.
#pragma once

#include <string>
#include <vector>

#include "interfaces/clouds/stored_cloud.hpp"

namespace swiftlet::apps {

inline constexpr const char* kUnitHint =
    "are they in metres? Give --scale 0.01 if in centimetres, 0.001 if in millimetres, 0.0254 if in inches";

/// "cloud.ply:3: its header says centimeters: give --scale 0.01"; empty if it says metres or nothing.
std::string headerUnitNote(const std::string& file, const interfaces::StoredCloud& cloud);

/// Of points that reach too far for a building in metres, or that look like longitude and latitude. Empty for others,
/// and where the header says another unit.
std::string extentNote(const interfaces::StoredCloud& cloud);

/// What is odd about a cloud that is to be a map: the notes of its reader, and without a scale that was given both
/// above.
std::vector<std::string> mapNotes(const std::string& file, const interfaces::StoredCloud& cloud, bool has_scale);

}  // namespace swiftlet::apps
