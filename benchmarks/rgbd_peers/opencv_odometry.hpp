// The odometries of OpenCV's module rgbd, from frame to frame, with their own defaults; and what some 60 lines make of
// its corners.
#pragma once

#include <vector>

#include "benchmarks/rgbd_peers/peer.hpp"

namespace swiftlet::rgbd_peers {

/// RgbdOdometry (grey values), ICPOdometry (surfaces) and RgbdICPOdometry (both); none where OpenCV is not installed.
std::vector<Contender> opencvContenders();
/// ORB corners of a frame, matched to those of a key frame: the pose by solvePnPRansac; none without features2d.
std::vector<Contender> orbPnpContenders();

}  // namespace swiftlet::rgbd_peers
