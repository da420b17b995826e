// In the place of orb_pnp.cpp where OpenCV's features2d is not installed.
#include "benchmarks/rgbd_peers/opencv_odometry.hpp"

namespace swiftlet::rgbd_peers {

std::vector<Contender> orbPnpContenders() { return {}; }

}  // namespace swiftlet::rgbd_peers
