// Makes the 3D map from RGB-D frames: finds the pose of each frame against what was seen before, and draws it.
//
//   frame, seed, key scans --> FrameOdometry (persistent model) --> pose --> SubmapStore (points, voxels)
//                                     \-- does not fit: left out
//
// Key frames and submaps hang on the key scans of the 2D map, so a loop closure moves them and draws nothing again.
// After Saeedi et al., Algorithm 1. Its model of corners and its bundle adjustment are one method (ModelIcp). The usual
// one aligns frames directly (RgbdOdometry, docs/decisions/mapping3d.md#032). With either, the poses of key frames
// follow those of the 2D map, or a graph of their own where there is none.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/disc.hpp"
#include "common/key_pose.hpp"
#include "common/rgbd_frame.hpp"
#include "common/submap3d.hpp"
#include "common/time.hpp"
#include "mapping3d/loops/key_frame_graph.hpp"
#include "mapping3d/loops/loop_search.hpp"
#include "mapping3d/model/submap_config.hpp"
#include "mapping3d/model/submap_store.hpp"
#include "mapping3d/odometry/focal_check.hpp"
#include "mapping3d/odometry/rgbd_odometry.hpp"
#include "mapping3d/voxels/voxel_config.hpp"

namespace swiftlet::mapping3d {

struct Mapper3dConfig {
  RgbdOdometryConfig odometry;
  VoxelConfig voxels;
  SubmapConfig submaps;
  /// Key frames that look most alike and are aligned to a new one, at most; 0 closes no loops.
  int loop_candidates = 5;
  KeyFrameGraphConfig graph;

  void describe(common::config::Fields& fields);
};

/// For a recording, of which only the camera is known: it may be any, in a room of any size. Cloud and voxels keep
/// their own ranges.
Mapper3dConfig configOfRecordings(RgbdOdometryConfig::Method method = RgbdOdometryConfig::Method::kDirect);

/// What other parts know at a frame's time.
struct FrameContext {
  std::optional<CameraSeed> seed;
  /// With at least one key scan. Null where there is no 2D map: then key frames take the place of key scans, and loops
  /// are closed by appearance. A map has scans in all of its frames or in none.
  std::shared_ptr<const common::KeyPoses> scans;
  std::span<const common::Disc> people;  ///< In `map`. Their pixels are left out.
  common::Duration depth_later = {};     ///< The depth was taken so much later than the colour.
};

/// The first key frame of a piece of the map. It is a lost frame, which the frame after it confirmed.
struct BegunPiece {
  common::Time stamp;
  int scan = 0;  ///< Its frame is that of the camera.
};

struct MappedFrame {
  RgbdPose pose;                    ///< T_map_camera is in the map of FrameContext::scans, or of Mapper3d::scans().
  common::Pose3 T_scan_camera;      ///< Relative to the key scan `pose.scan`: moves with the map.
  int loops = 0;                    ///< Loop closures that this frame has added.
  std::optional<BegunPiece> begun;  ///< By this frame and the lost one before it.
};

/// One thread. A function of its frames and their contexts.
class Mapper3d {
 public:
  explicit Mapper3d(const Mapper3dConfig& config);

  /// Frames come in the order of their stamps, and later contexts have the same or later versions of the key scans.
  MappedFrame add(const common::RgbdFrame& frame, const FrameContext& context);

  /// See SubmapStore::snapshot. It copies the points of the submap that grows.
  std::vector<common::Submap3d> submaps() { return submaps_.snapshot(); }
  const KeyFrameMap& keyFrames() const { return odometry_->keyFrames(); }
  /// What submaps and frames hang on where there is no 2D map.
  std::shared_ptr<const common::KeyPoses> scans() const { return graph_.poses(); }
  /// The piece of the map that hangs on a key frame, where there is no 2D map. Poses of different pieces have nothing
  /// to do with each other, until they are joined and have one number.
  int pieceOf(int scan) const { return graph_.pieceOf(scan); }
  /// See FocalCheck; without a 2D map only.
  std::optional<double> betterFocalFactor() const { return focal_.betterFactor(); }
  bool isFocalLengthChecked() const { return focal_.canTell(); }

 private:
  void beginPiece(MappedFrame& mapped);
  /// The newest key frame becomes a node of the graph, loops to it are closed, and pieces that it connects are joined.
  void grow(MappedFrame& mapped);
  void checkFocal(const RgbdPose& pose);

  Mapper3dConfig config_;
  std::unique_ptr<FrameOdometry> odometry_;
  KeyFrameGraph graph_;
  FocalCheck focal_;
  SubmapStore submaps_;
};

}  // namespace swiftlet::mapping3d
