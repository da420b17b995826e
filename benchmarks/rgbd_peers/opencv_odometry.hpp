// The odometries of OpenCV's module rgbd, from frame to frame, with their own defaults.
#pragma once

#include <vector>

#include "benchmarks/rgbd_peers/peer.hpp"

namespace swiftlet::rgbd_peers {

/// RgbdOdometry (grey values), ICPOdometry (surfaces) and RgbdICPOdometry (both); none where OpenCV is not installed.
std::vector<Contender> opencvContenders();

}  // namespace swiftlet::rgbd_peers
