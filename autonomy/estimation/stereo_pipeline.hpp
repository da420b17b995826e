// Measures the motion with a stereo camera. The heavy work is a job: depths by stereo, then visual odometry.
//
//   pair --> StereoMatcher --> RGB-D frame --> VisualOdometry, a job --> CameraStep for the filter
//     ^--- a newer pair replaces one that waits  |       \--> what lies below, compared with the beams down
//                                                \--> the frame itself, for the 3D map
//
// Pairs that cannot be used, a silent camera, depths that the beams down contradict, and times without visual odometry
// leave events.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "autonomy/arrivals/silence_watch.hpp"
#include "autonomy/estimation/odometry_step.hpp"
#include "autonomy/estimation/stereo_scale.hpp"
#include "common/event_log.hpp"
#include "common/hysteresis.hpp"
#include "common/jobs.hpp"
#include "common/message.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/rgbd_frame.hpp"
#include "common/time.hpp"
#include "perception/visual_odometry/visual_odometry.hpp"
#include "vision/features.hpp"

namespace swiftlet::autonomy {

/// The source of the events about stereo pairs, and the name of their jobs.
inline constexpr const char* kStereo = "stereo";

/// One thread. Its jobs refer to it, so it cannot be moved and must outlive them.
class StereoPipeline {
 public:
  StereoPipeline(const common::RgbdCameraConfig& camera, common::JobRunner& jobs, common::EventLog& log);
  ~StereoPipeline();
  StereoPipeline(const StereoPipeline&) = delete;
  StereoPipeline& operator=(const StereoPipeline&) = delete;

  void add(std::shared_ptr<const common::RgbdFrame> pair, common::Time now);
  /// Begins to work on the pair that waits, and detects a silent camera. To be called at every tick.
  void watch(common::Time now);
  /// What the last pair tells the filter, without a measurement if it showed no motion; nullopt if it was taken before.
  std::optional<CameraStep> take() { return std::exchange(step_, std::nullopt); }
  /// The left picture of the last pair, rectified, with depths; null if it was taken before, for a pair that cannot be
  /// used, and for one whose depths the beams down contradict.
  std::shared_ptr<const common::RgbdFrame> takeFrame() { return std::exchange(frame_, nullptr); }
  const common::Pose3& T_body_camera() const { return T_body_camera_; }
  /// How the depths err.
  const vision::DepthNoiseConfig& noise() const { return noise_; }
  /// See StereoScale::addBeams.
  void addBeams(common::Time stamp, double below_m, const Eigen::Quaterniond& R_level_body) {
    scale_.addBeams(stamp, below_m, R_level_body);
  }
  /// The filter no longer has the clones from which the measurements start.
  void forgetClones() { forget_ = true; }

 private:
  struct Job;
  struct Outcome {
    common::Message fault;  ///< Of the pair; without a name for one that could be used.
    perception::VisualStep step;
    std::vector<Eigen::Vector3f> below_body_m;                 ///< See pointsBelow_body_m.
    std::shared_ptr<const common::RgbdFrame> frame = nullptr;  ///< Null for a pair that could not be used.
  };
  void take(const Outcome& outcome, common::Time delivered);
  common::Message missingOf(const Outcome& outcome, common::Time delivered);
  void warnOnce(const char* what, const common::Message& fault, common::Time now);
  void report(const common::Message& missing, common::Time now);

  common::EventLog& log_;
  common::JobRunner& jobs_;
  common::Pose3 T_body_camera_;
  std::shared_ptr<Job> job_;  ///< Belongs to the job while one is outstanding.
  vision::DepthNoiseConfig noise_;
  SilenceWatch silence_;
  std::shared_ptr<const common::RgbdFrame> waiting_;  ///< Null without one.
  std::optional<common::Time> last_measured_;         ///< Of the last pair that was taken.
  std::set<std::string> faults_;                      ///< Names of those that left a warning.
  common::Hysteresis blind_;
  StereoScale scale_;
  bool forget_ = false;
  std::optional<CameraStep> step_;
  std::shared_ptr<const common::RgbdFrame> frame_;  ///< See takeFrame.
};

/// The motion of the body that carries the camera, as a measurement for the filter.
perception::Measurement bodyMeasurement(const perception::VisualMotion& motion, const common::Pose3& T_body_camera);

}  // namespace swiftlet::autonomy
