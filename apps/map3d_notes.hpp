// Notes of `swiftlet map3d` on a recording: its oddities, and why it cannot be mapped.
#pragma once

#include <string>
#include <vector>

#include "apps/map3d_run.hpp"
#include "apps/map3d_trust.hpp"
#include "interfaces/rgbd/rgbd_folder.hpp"

namespace swiftlet::apps {

/// For people; empty if nothing is odd.
std::vector<std::string> map3dNotes(const interfaces::RgbdFolder& folder, const Map3dRun& run,
                                    const std::vector<MapPiece>& pieces, const Map3dTrust& trust);

/// What to do about a recording of which no frame was tracked.
std::string map3dRemedy(const interfaces::RgbdFolder& folder, const Map3dRun& run);

}  // namespace swiftlet::apps
