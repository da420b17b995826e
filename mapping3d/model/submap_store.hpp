// The submaps of a 3D map: one that grows, and those that were left.
//
// Each frame is drawn into one submap only, so that the evidence of all submaps can be added.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/disc.hpp"
#include "common/geometry.hpp"
#include "common/key_pose.hpp"
#include "common/rgbd_frame.hpp"
#include "common/submap3d.hpp"
#include "mapping3d/model/point_grid.hpp"
#include "mapping3d/model/submap_config.hpp"
#include "mapping3d/voxels/voxel_mapper.hpp"
#include "vision/features.hpp"

namespace swiftlet::mapping3d {

/// A frame with what is known of it.
struct PlacedFrame {
  const common::RgbdFrame& frame;
  const common::RgbdFrame& still;  ///< The frame without the depths that lie on people.
  common::Pose3 T_map_camera;
  int scan = 0;  ///< The key scan on which a submap that begins here hangs.
  std::span<const common::Disc> people;
  bool is_key_frame = false;
};

/// One thread.
class SubmapStore {
 public:
  SubmapStore(const SubmapConfig& config, const VoxelConfig& voxels, const vision::DepthNoiseConfig& noise);

  void draw(const PlacedFrame& placed, const common::KeyPoses& scans);
  /// All submaps as they are now, in the order of their making. Those that were left are the same objects as before.
  std::vector<common::Submap3d> snapshot();

 private:
  struct Growing {
    int scan = 0;
    common::Pose3 T_scan_submap;
    VoxelMapper voxels;
    PointGrid points;
    std::uint64_t frames = 0;

    common::Pose3 T_map_submap(const common::KeyPoses& scans) const { return scans.T_map_level(scan) * T_scan_submap; }
  };
  struct Left {
    common::Submap3d submap;
    double cube_m = 0.0;
  };
  void begin(const PlacedFrame& placed, const common::KeyPoses& scans);
  void leave();
  void thinOldest();

  SubmapConfig config_;
  VoxelConfig voxels_;
  vision::DepthNoiseConfig noise_;
  std::optional<Growing> growing_;
  std::vector<Left> left_;
};

}  // namespace swiftlet::mapping3d
