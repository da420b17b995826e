// Poses of the body in the map at the times of other sensors: by the place of the last scan, and the filter's motion
// since then.
#pragma once

#include <optional>

#include "autonomy/estimation/rgbd_pipeline.hpp"
#include "autonomy/estimation/vertical_laser_pipeline.hpp"
#include "common/key_pose.hpp"
#include "common/time.hpp"
#include "perception/fusion/error_state_filter.hpp"

namespace swiftlet::autonomy {

/// One thread. Refers to the filter.
class PoseTrack {
 public:
  explicit PoseTrack(const perception::ErrorStateFilter& filter) : filter_(filter) {}

  /// A scan was processed. `at_key`: the place of the body in the map, nullopt before the first map.
  void scanned(common::Time stamp, const std::optional<common::KeyRelativePose>& at_key,
               const common::Pose3& T_odom_body);
  /// A scan matched, at `now`.
  void matched(common::Time now) { matched_ = now; }

  /// Whether the pose at `time` is to be used at `now`: the filter has reached it, and a scan of that time has been
  /// processed, or is not worth waiting for any longer.
  bool isKnown(common::Time time, common::Time now, common::Time wait_until) const;
  /// Whether a scan has just measured the place in the map, which otherwise is only predicted.
  bool isSupported(common::Time now) const;

  /// The frame `odom` as of the last scan relative to a key scan; nullopt before the first map.
  const std::optional<common::KeyRelativePose>& odomAtKey() const { return odom_at_key_; }
  std::optional<common::KeyRelativePose> atKey(common::Time time) const;
  /// The filter's attitude at a time, and how its pose changes around it.
  std::optional<BodyAtFrame> bodyAt(common::Time time) const;
  /// The poses during a sweep, without the people; nullopt where the place in the map is only predicted.
  std::optional<SweepSituation> during(const VerticalLaserPipeline::Interval& times, common::Time now) const;

 private:
  const perception::ErrorStateFilter& filter_;
  std::optional<common::KeyRelativePose> odom_at_key_;
  common::Time scanned_;  ///< The stamp of the last scan that was processed.
  common::Time matched_;  ///< When the last scan that matched was processed.
};

}  // namespace swiftlet::autonomy
