// A cloud of coloured points, thinned by a grid: one point a cube, the mean of all that fell into it.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "interfaces/files/ply.hpp"

namespace swiftlet::apps {

class CloudGrid {
 public:
  explicit CloudGrid(double cube_m) : cube_m_(cube_m) {}

  /// Adds the frame's measured points up to `farthest_m`.
  void add(const common::RgbdFrame& frame, const common::Pose3& T_map_camera, double farthest_m);
  /// In the order of their cubes, so that equal clouds give equal files.
  std::vector<interfaces::ColoredPoint> points() const;

 private:
  struct Sums {
    Eigen::Vector3d points_m = Eigen::Vector3d::Zero();
    std::uint32_t red = 0, green = 0, blue = 0, count = 0;
  };
  double cube_m_;
  std::unordered_map<std::uint64_t, Sums> cubes_;
};

}  // namespace swiftlet::apps
