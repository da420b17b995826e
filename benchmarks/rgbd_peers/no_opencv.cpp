// In the place of opencv_odometry.cpp where OpenCV is not installed.
#include "benchmarks/rgbd_peers/opencv_odometry.hpp"

namespace swiftlet::rgbd_peers {

std::vector<Contender> opencvContenders() { return {}; }

}  // namespace swiftlet::rgbd_peers
