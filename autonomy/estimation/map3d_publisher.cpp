#include "autonomy/estimation/map3d_publisher.hpp"

#include <algorithm>
#include <utility>

#include "mapping3d/model/submap_fusion.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Duration;
using common::Time;

constexpr const char* kFusion3d = "mapping3d fusion";
/// Time between copies of the growing submap for viewers.
constexpr double kPublishPeriod_s = 0.4;
/// Time between fusions of all submaps to one map; after a loop closure they are fused at once.
constexpr double kFusionPeriod_s = 10.0;
/// Declared time for fusing them.
constexpr double kFusionLatency_s = 2.0;
/// About the reach of a submap: a turn moves points at that distance.
constexpr double kSubmapReach_m = 5.0;
/// A sensor whose work has not copied the submaps for this many periods has stopped.
constexpr double kLatePeriods = 2.0;

}  // namespace

Map3dPublisher::Map3dPublisher(double resolution_m, common::JobRunner& jobs)
    : resolution_m_(resolution_m), jobs_(jobs) {}

bool Map3dPublisher::begin(Time now) {
  const bool publish = !submaps_stamp_ || (now - *submaps_stamp_).seconds() >= kPublishPeriod_s;
  if (publish) submaps_stamp_ = now;
  behind_ = !publish;
  return publish;
}

bool Map3dPublisher::beginLate(Time now) {
  if (!behind_ || (now - *submaps_stamp_).seconds() < kLatePeriods * kPublishPeriod_s) return false;
  submaps_stamp_ = now;
  behind_ = false;
  return true;
}

void Map3dPublisher::setSubmaps(std::vector<common::Submap3d> submaps) {
  change().submaps = std::make_shared<const std::vector<common::Submap3d>>(std::move(submaps));
}

common::Map3dLayer& Map3dPublisher::change() {
  if (!layer_) {
    layer_ = std::make_shared<common::Map3dLayer>();
    layer_->submaps = std::make_shared<const std::vector<common::Submap3d>>();
  }
  changed_ = true;
  return *layer_;
}

bool Map3dPublisher::isStale(const std::shared_ptr<const common::KeyPoses>& keys) const {
  return layer_ && (changed_ || !published_ || published_->keys != keys);
}

std::shared_ptr<const common::Map3dLayer> Map3dPublisher::layer(const std::shared_ptr<const common::KeyPoses>& keys) {
  if (!isStale(keys)) return published_;
  changed_ = false;
  layer_->keys = keys;
  published_ = std::make_shared<const common::Map3dLayer>(*layer_);
  return published_;
}

/// Whether a submap has moved by a voxel since the last fusion.
bool Map3dPublisher::hasMoved(const common::KeyPoses& keys) const {
  for (const common::Submap3d& submap : *layer_->submaps) {
    if (submap.key >= static_cast<int>(std::min(keys.keys.size(), fused_keys_->keys.size()))) continue;
    const common::Pose3 moved = submap.T_map_submap(*fused_keys_).inverse() * submap.T_map_submap(keys);
    if (moved.position_m.norm() + kSubmapReach_m * common::logSO3(moved.rotation).norm() > resolution_m_) return true;
  }
  return false;
}

void Map3dPublisher::fuse(const std::shared_ptr<const common::KeyPoses>& keys, Time now) {
  if (!layer_ || layer_->submaps->empty() || !jobs_.idle(kFusion3d)) return;
  const bool due = !fused_from_ || (now - *fused_from_).seconds() >= kFusionPeriod_s;
  if (!due && (fused_keys_ == keys || !hasMoved(*keys))) return;
  fused_from_ = now;
  fused_keys_ = keys;
  jobs_.submit(
      kFusion3d, now, Duration::fromSeconds(kFusionLatency_s),
      [this, submaps = layer_->submaps, keys, now, resolution_m = resolution_m_]() -> common::JobRunner::Deliver {
        auto fused = std::make_shared<const common::VoxelMap>(mapping3d::fuse(*submaps, *keys, resolution_m));
        return [this, fused, now](Time) {
          common::Map3dLayer& layer = change();
          layer.fused = fused;
          layer.fused_stamp = now;
        };
      });
}

}  // namespace swiftlet::autonomy
