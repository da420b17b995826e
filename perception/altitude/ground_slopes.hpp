// How the ground slopes where a depth camera saw it. The beams that a mirror deflects down meet one place at a time:
// whether the ground rises or the vehicle sinks is the same to them. A camera sees some square metres at once, and its
// attitude is known to about a degree, so it distinguishes a ramp of some degrees from level ground.
//
//   depth image --> points below the hull, in the map --> a plane in each cell --> minus what level ground seems to
//                   slope, as attitude and mount are wrong --> mean gradient of the cell
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "perception/altitude/keyed_cells.hpp"

namespace swiftlet::perception {

/// One thread. In the frame `map`.
class GroundSlopes {
 public:
  GroundSlopes();

  /// Moves and turns what was seen with the key scans of the map; see KeyedCells.
  void follow(const common::KeyPoses& keys, int newest_key) { cells_.follow(keys, newest_key); }

  /// Takes in a depth image, taken from that pose. Only differences of height count, so that a wrong height of the pose
  /// does no harm. Cells with a step, furniture or too few points in them are left out.
  void add(const common::DepthImage& depth, const common::PinholeCamera& camera, const common::Pose3& T_map_camera);

  /// The gradient (rise over run, to the east and north) of the ground at a place: zero where it is level within what
  /// the camera can tell; none where it was not seen often enough.
  std::optional<Eigen::Vector2d> gradientAt(const Eigen::Vector2d& place_map_m) const;

 private:
  struct Cell {
    Eigen::Vector2d gradient_sum = Eigen::Vector2d::Zero();  ///< Along the axes of its square.
    int images = 0;
  };
  KeyedCells<Cell> cells_;
  /// The gradient that level ground seems to have, ahead and to the left of the camera.
  Eigen::Vector2d bias_ = Eigen::Vector2d::Zero();
};

}  // namespace swiftlet::perception
