// The World's layer of the 3D map: what the RGB-D camera, or a laser whose scan plane stands upright, has mapped.
#pragma once

#include <memory>
#include <vector>

#include "common/geometry.hpp"
#include "common/time.hpp"

namespace swiftlet::common {

struct KeyPoses;
struct RgbdFrame;
struct Submap3d;
class VoxelMap;

/// Mount and clock of the camera, as the flight has estimated them.
struct CameraEstimate {
  Pose3 T_body_camera;                                        ///< Of the data sheet, except for what is known better.
  Eigen::Vector3d mount_sigma_rad = Eigen::Vector3d::Zero();  ///< Of the camera's attitude, about the axes of the body.
  double clock_offset_s = 0.0;                                ///< How late its stamps are by the flight's clock.
  double clock_sigma_s = 0.0;
};

/// Only `fused` and `frame` may be null.
struct Map3dLayer {
  /// In the order of their making; the growing one is another object at each change.
  std::shared_ptr<const std::vector<Submap3d>> submaps;
  std::shared_ptr<const KeyPoses> keys;  ///< The key scans that `submaps` refer to.
  /// All submaps in the frame `map`, made in the background; null before the first.
  std::shared_ptr<const VoxelMap> fused;
  Time fused_stamp;                        ///< When the submaps and poses of `fused` were those of the flight.
  std::shared_ptr<const RgbdFrame> frame;  ///< The newest that was processed; null without a camera.
  Pose3 T_map_camera;                      ///< At its stamp.
  CameraEstimate camera;
  bool tracked = false;  ///< Whether that frame was aligned to the map; else its pose is predicted.
};

}  // namespace swiftlet::common
