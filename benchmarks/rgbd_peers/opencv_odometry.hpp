// The odometry of OpenCV's module rgbd, from frame to frame, with its own defaults.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "benchmarks/rgbd_peers/peer.hpp"

namespace swiftlet::rgbd_peers {

/// "RgbdOdometry" (grey values), "ICPOdometry" (surfaces) or "RgbdICPOdometry" (both).
std::unique_ptr<Peer> opencvOdometry(const std::string& kind);

/// On one thread, as ours is.
void useOneThread();

}  // namespace swiftlet::rgbd_peers
