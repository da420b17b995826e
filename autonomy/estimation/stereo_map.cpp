#include "autonomy/estimation/stereo_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/disc.hpp"
#include "common/submap3d.hpp"
#include "mapping3d/model/frame_without_people.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Duration;
using common::Pose3;
using common::Time;

/// Greatest wait of a frame for a scan that is not older: two scans of a laser at 40 Hz. Pairs come later than scans,
/// so that they hardly ever wait.
constexpr Duration kStereoWait = Duration::fromMilliseconds(50);

/// Up to where the standard deviation of a depth is a voxel.
double certainRange_m(const vision::DepthNoiseConfig& noise, double resolution_m) {
  return std::sqrt(resolution_m / noise.sigma_per_m2);
}

std::shared_ptr<mapping3d::SubmapStore> storeFor(const mapping3d::Mapper3dConfig& config,
                                                 const vision::DepthNoiseConfig& noise) {
  mapping3d::VoxelConfig voxels = config.voxels;
  mapping3d::SubmapConfig submaps = config.submaps;
  const double range_m = certainRange_m(noise, voxels.resolution_m);
  voxels.range_max_m = std::min(voxels.range_max_m, range_m);
  submaps.point_range_m = std::min(submaps.point_range_m, range_m);
  return std::make_shared<mapping3d::SubmapStore>(submaps, voxels, noise);
}

/// What the job draws.
struct PlacedByEstimate {
  std::shared_ptr<const common::RgbdFrame> frame;
  std::shared_ptr<const common::KeyPoses> keys;
  Pose3 T_map_camera;
  int key = 0;
  std::vector<common::Disc> people;

  void drawInto(mapping3d::SubmapStore& submaps) const {
    const bool mask = !people.empty();
    const common::RgbdFrame masked =
        mask ? mapping3d::withoutPeople(*frame, T_map_camera, people) : common::RgbdFrame{};
    submaps.draw({*frame, mask ? masked : *frame, T_map_camera, key, people}, *keys);
  }
};

}  // namespace

StereoMap::StereoMap(const RgbdPipelineConfig& config, const common::RgbdCameraConfig& camera,
                     const vision::DepthNoiseConfig& noise, common::JobRunner& jobs)
    : latency_(Duration::fromSeconds(config.latency_s)),
      T_body_camera_(camera.mount.pose()),
      jobs_(jobs),
      submaps_(storeFor(config.mapper, noise)),
      publisher_(config.mapper.voxels.resolution_m, jobs) {}

std::optional<Time> StereoMap::next() const {
  if (!waiting_ || !jobs_.idle(kMapping3d)) return std::nullopt;
  return waiting_->stamps.measured;
}

Time StereoMap::waitUntil() const { return waiting_->stamps.arrived + kStereoWait; }

void StereoMap::map(const FrameSituation& situation, Time now) {
  auto frame = std::exchange(waiting_, nullptr);
  if (situation.keys->keys.empty() || !situation.at_key || !situation.supported) return;
  PlacedByEstimate placed{frame, situation.keys, situation.keys->inMap(*situation.at_key) * T_body_camera_,
                          situation.at_key->key, situation.people};
  const bool copy = publisher_.begin(now);
  jobs_.submit(kMapping3d, now, latency_,
               [this, submaps = submaps_, placed = std::move(placed), at_key = *situation.at_key,
                copy]() -> common::JobRunner::Deliver {
                 placed.drawInto(*submaps);
                 std::optional<std::vector<common::Submap3d>> copied;
                 if (copy) copied = submaps->snapshot();
                 return [this, frame = placed.frame, at_key, copied = std::move(copied)](Time) {
                   if (copied) publisher_.setSubmaps(*copied);
                   publish(frame, at_key);
                 };
               });
}

void StereoMap::publish(std::shared_ptr<const common::RgbdFrame> frame, const common::KeyRelativePose& at_key) {
  common::Map3dLayer& layer = publisher_.change();
  layer.camera.T_body_camera = T_body_camera_;
  layer.frame = std::move(frame);
  layer.tracked = true;
  at_key_ = at_key;
}

void StereoMap::watch(const std::shared_ptr<const common::KeyPoses>& keys, Time now) {
  publisher_.fuse(keys, now);
  if (waiting_ || !jobs_.idle(kMapping3d) || !publisher_.beginLate(now)) return;
  jobs_.submit(kMapping3d, now, latency_, [this, submaps = submaps_]() -> common::JobRunner::Deliver {
    return [this, copied = submaps->snapshot()](Time) { publisher_.setSubmaps(copied); };
  });
}

std::shared_ptr<const common::Map3dLayer> StereoMap::layer(const std::shared_ptr<const common::KeyPoses>& keys) {
  if (publisher_.isStale(keys)) publisher_.change().T_map_camera = keys->inMap(at_key_) * T_body_camera_;
  return publisher_.layer(keys);
}

}  // namespace swiftlet::autonomy
