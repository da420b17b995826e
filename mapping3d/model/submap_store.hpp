// The submaps of a 3D map: the growing one, and those that were left. A left submap is continued when the sensor
// comes back, so that the map grows with the building and not with the flight. It does so only while the 2D map places
// the frame by the submap's own key scans or by neighbours of them: after a long path the drift would be drawn into it,
// where no loop closure could take it out again.
//
// Each frame is drawn into one submap only, so that the evidence of all submaps can be added.
#pragma once

#include <optional>
#include <set>
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

/// A frame with its pose and context.
struct PlacedFrame {
  const common::RgbdFrame& frame;
  const common::RgbdFrame& still;  ///< The frame without the depths that lie on people.
  common::Pose3 T_map_camera;
  int scan = 0;  ///< The key scan on which a submap that begins here hangs.
  std::span<const common::Disc> people;
  bool is_key_frame = false;
  int piece = 0;  ///< Of the map: a submap is in one only.
};

/// One sweep of a laser.
struct PlacedSweep {
  std::vector<Ray> rays_scan;  ///< In the level frame of the key scan. Each has the origin of its own time.
  int scan = 0;                ///< As in PlacedFrame.
  std::vector<common::Disc> people;
  float weight_1_m2 = 1e4F;  ///< The inverse variance of a range.
};

/// One thread.
class SubmapStore {
 public:
  /// `noise` is that of the depths of frames; sweeps have a weight of their own.
  SubmapStore(const SubmapConfig& config, const VoxelConfig& voxels, const vision::DepthNoiseConfig& noise = {});

  void draw(const PlacedFrame& placed, const common::KeyPoses& scans);
  /// The points have no normals and are grey: a laser sees neither.
  void draw(const PlacedSweep& placed, const common::KeyPoses& scans);
  /// The submaps of the piece `from` become those of `into`.
  void joinPieces(int from, int into);
  /// All submaps as they are now, in the order of their making. Those that do not grow are the same objects as before.
  std::vector<common::Submap3d> snapshot();

 private:
  struct Kept {
    common::Submap3d submap;     ///< As it was when it was left.
    std::vector<float> weights;  ///< WeightedPoints of its points.
    std::set<int> scans;         ///< The key scans of the frames that were drawn into it.
    int piece = 0;

    void take(WeightedPoints points);
  };
  /// One of those that are kept, while it grows.
  struct Growing {
    std::size_t index = 0;
    VoxelMapper voxels;
    PointGrid points;
    std::uint64_t frames = 0;
  };
  /// A sensor that draws.
  struct Place {
    const Eigen::Vector3d& sensor_map_m;
    int scan = 0;
    int piece = 0;
  };
  /// Makes the submap grow into which a sensor there draws, and returns its place.
  common::Pose3 enter(const Place& place, const common::KeyPoses& scans);
  std::optional<std::size_t> known(const Place& place, const common::KeyPoses& scans) const;
  std::size_t add(const Place& place, const common::KeyPoses& scans);
  void grow(std::size_t index);
  void leave();
  void thinOldest();
  void forgetOldest();

  SubmapConfig config_;
  VoxelConfig voxels_;
  vision::DepthNoiseConfig noise_;
  std::uint64_t frames_ = 0;  ///< Number of frames drawn.
  std::vector<Kept> kept_;
  std::optional<Growing> growing_;
};

}  // namespace swiftlet::mapping3d
