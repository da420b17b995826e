// The World's layer of the 3D map, whatever sensor makes the submaps: when they are published, and their fusion to one
// map, a job.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/jobs.hpp"
#include "common/key_pose.hpp"
#include "common/submap3d.hpp"
#include "common/world/map3d_layer.hpp"

namespace swiftlet::autonomy {

/// One thread. Its jobs refer to it, so it cannot be moved and must outlive them.
class Map3dPublisher {
 public:
  Map3dPublisher(double resolution_m, common::JobRunner& jobs);
  Map3dPublisher(const Map3dPublisher&) = delete;
  Map3dPublisher& operator=(const Map3dPublisher&) = delete;

  /// Whether the submaps are to be copied by the work that begins now; they are then as of `now`.
  bool begin(common::Time now);
  /// Whether the submaps are to be copied though no work begins, because the sensor has stopped since the last copy and
  /// its last measurements are in no copy; they are then as of `now`.
  bool beginLate(common::Time now);
  void setSubmaps(std::vector<common::Submap3d> submaps);
  /// Fuses all submaps again: every 10 s, and at once when a loop closure has moved one by a voxel or
  /// more. To be called at every tick.
  void fuse(const std::shared_ptr<const common::KeyPoses>& keys, common::Time now);

  bool hasLayer() const { return layer_ != nullptr; }
  /// The layer that is published next, made at the first call. It counts as changed.
  common::Map3dLayer& change();
  /// Whether layer() would return another layer than before.
  bool isStale(const std::shared_ptr<const common::KeyPoses>& keys) const;
  /// The layer with these key scans; null before the first change. The same object until something changes.
  std::shared_ptr<const common::Map3dLayer> layer(const std::shared_ptr<const common::KeyPoses>& keys);

 private:
  bool hasMoved(const common::KeyPoses& keys) const;

  double resolution_m_;
  common::JobRunner& jobs_;
  std::shared_ptr<common::Map3dLayer> layer_;  ///< The next one to be published.
  std::shared_ptr<const common::Map3dLayer> published_;
  bool changed_ = false;
  bool behind_ = false;                                 ///< Work has begun after the last copy of the submaps.
  std::optional<common::Time> submaps_stamp_;           ///< When the submaps of the layer were taken.
  std::optional<common::Time> fused_from_;              ///< Time of the last fusion.
  std::shared_ptr<const common::KeyPoses> fused_keys_;  ///< Key scans that the last fusion used.
};

}  // namespace swiftlet::autonomy
