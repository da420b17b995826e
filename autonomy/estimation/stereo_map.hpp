// Makes the 3D map from the frames that the pairs of a stereo camera have become. From then on they are RGB-D frames
// like any other: their obstacles enter the same voxels as those of an Xtion.
//
//   frame --> waits until the pose at its time is known --> SubmapStore (points, voxels), a job --> Map3dLayer
//     ^--- a newer frame replaces it
//
// Frames are placed by the estimate, which knows their motion by visual odometry, and are not aligned once more: their
// depths are too uncertain to show a pose better than their corners do. A depth counts up to where its standard
// deviation is a voxel; farther away a surface would be smeared over several.
#pragma once

#include <memory>
#include <optional>

#include "autonomy/estimation/frame_situation.hpp"
#include "autonomy/estimation/map3d_publisher.hpp"
#include "autonomy/estimation/rgbd_pipeline_config.hpp"
#include "common/jobs.hpp"
#include "common/key_pose.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/rgbd_frame.hpp"
#include "common/time.hpp"
#include "common/world/map3d_layer.hpp"
#include "mapping3d/model/submap_store.hpp"
#include "vision/features.hpp"

namespace swiftlet::autonomy {

/// One thread. Its jobs refer to it, so it cannot be moved and must outlive them.
class StereoMap {
 public:
  /// `noise` is that of the depths. Of the configuration the voxels, the submaps and the latencies are used.
  StereoMap(const RgbdPipelineConfig& config, const common::RgbdCameraConfig& camera,
            const vision::DepthNoiseConfig& noise, common::JobRunner& jobs);
  StereoMap(const StereoMap&) = delete;
  StereoMap& operator=(const StereoMap&) = delete;

  /// See StereoPipeline::takeFrame.
  void add(std::shared_ptr<const common::RgbdFrame> frame) { waiting_ = std::move(frame); }
  /// The time at which the frame that is next to be drawn was measured; nullopt while there is none, or while another
  /// one is being drawn.
  std::optional<common::Time> next() const;
  /// Until then it is worth waiting for a scan of its time. Only if there is a next one.
  common::Time waitUntil() const;
  /// Draws the next frame. One whose place in the map is only predicted is left out.
  void map(const FrameSituation& situation, common::Time now);
  /// Copies and fuses the submaps if it is time. To be called at every tick.
  void watch(const std::shared_ptr<const common::KeyPoses>& keys, common::Time now);

  /// The layer with these key scans; null before the first frame. The same object until something changes.
  std::shared_ptr<const common::Map3dLayer> layer(const std::shared_ptr<const common::KeyPoses>& keys);

 private:
  void publish(std::shared_ptr<const common::RgbdFrame> frame, const common::KeyRelativePose& at_key);

  common::Duration latency_;
  common::Pose3 T_body_camera_;
  common::JobRunner& jobs_;
  std::shared_ptr<mapping3d::SubmapStore> submaps_;   ///< Belongs to the job while one is outstanding.
  std::shared_ptr<const common::RgbdFrame> waiting_;  ///< Null without one.
  Map3dPublisher publisher_;
  common::KeyRelativePose at_key_;  ///< The body at the newest frame of the layer.
};

}  // namespace swiftlet::autonomy
