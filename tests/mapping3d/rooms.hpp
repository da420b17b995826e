// Depth images of a box-shaped room with boxes in it, computed exactly.
#pragma once

#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "mapping3d/voxels/voxel_mapper.hpp"

namespace swiftlet::mapping3d {

struct Room {
  Eigen::AlignedBox3d walls{Eigen::Vector3d(-3, -2, 0), Eigen::Vector3d(4, 3, 2.5)};
  std::vector<Eigen::AlignedBox3d> boxes;
};

/// As Xtion and Kinect at a quarter of their resolution.
common::PinholeCamera smallCamera();
/// The Xtion of config/sensors: at the end of its range a voxel of 5 cm is three pixels wide.
common::PinholeCamera xtion();
/// A frame in which the walls do not lie on boundaries of voxels, where rounding decides.
inline const common::Pose3 T_map_room{common::quaternionFrom({0.0, 0.0, 0.3}), {0.013, 0.021, 0.017}};
Room randomRoom(std::mt19937& random);
/// A pose in free space, looking anywhere.
common::Pose3 randomView(const Room& room, std::mt19937& random);
/// Some pixels are unknown and some report that they are too far, at random with these shares.
common::DepthImage depthImage(const Room& room, const common::PinholeCamera& camera, const common::Pose3& T_map_camera,
                              std::mt19937& random, double unknown_share = 0.0, double too_far_share = 0.0);

/// From one place to each of the points.
std::vector<Ray> raysFrom(const Eigen::Vector3d& origin_m, const std::vector<Eigen::Vector3d>& ends_m);

}  // namespace swiftlet::mapping3d
