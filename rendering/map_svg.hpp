// The map with trajectories as one SVG picture for the report. The grid is an embedded PNG; the lines stay sharp at any
// size.
#pragma once

#include <string>

#include "rendering/map_picture.hpp"

namespace swiftlet::rendering {

/// Grid, levels and frontiers as in renderMap(). Above them are all lines, dashed if their style says so, and all marks
/// with their names. The scan is left out.
std::string mapSvg(const MapPicture& picture, int width_px = 720);

}  // namespace swiftlet::rendering
