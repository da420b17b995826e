// Finds coloured targets in the frames of an RGB-D camera and places them in the map. Looking for them in a frame is a
// job, a function of the frame alone; following them is done when it is delivered.
//
//   frame --> waits until the pose at its time is known --> TargetDetector, a job --> TargetTracker --> TargetsLayer
//                 ^--- a newer frame replaces it
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "autonomy/estimation/frame_queue.hpp"
#include "common/config_fwd.hpp"
#include "common/event_log.hpp"
#include "common/jobs.hpp"
#include "common/key_pose.hpp"
#include "common/place_names.hpp"
#include "common/rgbd_frame.hpp"
#include "common/world/map3d_layer.hpp"
#include "common/world/targets_layer.hpp"
#include "perception/targets/target_detector.hpp"
#include "perception/targets/target_tracker.hpp"

namespace swiftlet::autonomy {

struct TargetPipelineConfig {
  std::vector<perception::TargetClassConfig> classes;
  perception::TargetTrackerConfig tracker;

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
  std::vector<std::string> names() const;
};

/// One thread. Its jobs refer to it, so it cannot be moved and must outlive them.
class TargetPipeline {
 public:
  /// `range_m` is that of the camera.
  TargetPipeline(const TargetPipelineConfig& config, common::JobRunner& jobs, double range_m, common::EventLog& log);
  TargetPipeline(const TargetPipeline&) = delete;
  TargetPipeline& operator=(const TargetPipeline&) = delete;

  /// Of frames that RgbdPipeline::add accepts. A newer one replaces the one that waits.
  void add(std::shared_ptr<const common::RgbdFrame> frame) { frames_.add(std::move(frame)); }
  /// See FrameQueue::next; nullopt also while another frame is being processed.
  std::optional<common::Time> next(double clock_offset_s) const;
  /// See FrameQueue::waitUntil.
  common::Time waitUntil() const { return frames_.waitUntil(); }
  /// Looks for targets in that frame. Without a pose that a measurement supports it is left out.
  void look(const FrameSituation& situation, const common::CameraEstimate& camera, double drift_m, common::Time now);

  std::vector<common::Target> targets(const common::KeyPoses& keys) const { return tracker_.targets(keys); }
  /// Reports those that were found since the last call, by these names of places.
  void reportFound(const common::PlaceNames& names);

 private:
  struct Found {
    common::Time at;
    common::Target target;
  };
  void take(const std::vector<perception::TargetSighting>& sightings, const PlacedFrame& placed,
            common::Time delivered);

  TargetPipelineConfig config_;
  common::JobRunner& jobs_;
  std::shared_ptr<const perception::TargetDetector> detector_;
  perception::TargetTracker tracker_;
  FrameQueue frames_;
  std::vector<int> found_;  ///< The ids of those that were reported.
  std::vector<Found> unreported_;
  common::EventLog& log_;
};

}  // namespace swiftlet::autonomy
