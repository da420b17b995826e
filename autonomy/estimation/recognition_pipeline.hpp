// Recognizes what the profile names in the frames of a camera, and places it in the map. Recognizing is a job, a
// function of the frame, the scan of its time and the map; following is done when it is delivered.
//
//   frame --> waits until the pose at its time is known --> KnownObjects, a job --> ObjectTracker --> ObjectsLayer
//   scan  --> the one that is nearest in time, and what the map has where it sees nothing --^
//
// An RGB-D camera shows openings and patterns, the left picture of a stereo camera patterns.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "autonomy/estimation/frame_queue.hpp"
#include "autonomy/estimation/pose_track.hpp"
#include "common/event_log.hpp"
#include "common/jobs.hpp"
#include "common/key_pose.hpp"
#include "common/occupancy_grid.hpp"
#include "common/place_names.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle_config.hpp"
#include "common/world/objects_layer.hpp"
#include "perception/recognition/known_objects.hpp"
#include "perception/recognition/object_tracker.hpp"

namespace swiftlet::autonomy {

/// One thread. Its jobs refer to it, so it cannot be moved and must outlive them.
class RecognitionPipeline {
 public:
  /// `objects` must be a list of which KnownObjects can be made.
  RecognitionPipeline(const std::vector<perception::KnownObjectConfig>& objects, const common::RgbdCameraConfig& camera,
                      const common::LaserConfig& laser, common::JobRunner& jobs, common::EventLog& log);
  RecognitionPipeline(const RecognitionPipeline&) = delete;
  RecognitionPipeline& operator=(const RecognitionPipeline&) = delete;

  /// Of frames that can be used: of an RGB-D camera, or rectified ones of a stereo camera. A newer one replaces the one
  /// that waits.
  void add(std::shared_ptr<const common::RgbdFrame> frame) { frames_.add(std::move(frame)); }
  void add(const common::LaserScan& scan);
  /// See FrameQueue::next; nullopt also while another frame is being processed.
  std::optional<common::Time> next(double clock_offset_s) const;
  /// See FrameQueue::waitUntil.
  common::Time waitUntil() const { return frames_.waitUntil(); }

  /// Further data of the estimator.
  struct Context {
    const PoseTrack& poses;
    std::shared_ptr<const common::OccupancyGrid> grid;  ///< Never null.
    double drift_m = 0.0;                               ///< See DriftMonitor.
  };
  /// Looks at the next frame, taken at `time` by a camera with that mount. Without a pose that a measurement supports
  /// it is left out.
  void look(const FrameSituation& situation, const common::Pose3& T_body_camera, common::Time time,
            const Context& context, common::Time now);

  /// All in the map. Never null.
  std::shared_ptr<const common::ObjectsLayer> layer(const common::KeyPoses& keys) const;
  /// Reports those that were confirmed, or found to be something else, since the last call.
  void report(const common::KeyPoses& keys, const common::PlaceNames& names, common::Time now);

 private:
  /// A scan with the laser's pose at the time of a frame.
  struct PlacedScan {
    std::shared_ptr<const common::LaserScan> scan;
    common::Pose3 T_camera_laser, T_map_laser;
    std::shared_ptr<const common::OccupancyGrid> grid;
  };
  struct Said {
    std::string what;
    common::Passage passage = common::Passage::kNone;
    bool operator==(const Said&) const = default;
  };
  common::Time middleOf(const common::LaserScan& scan) const;
  std::optional<PlacedScan> scanAt(const PlacedFrame& placed, common::Time time, const Context& context) const;
  static std::vector<perception::Recognized> recognize(perception::KnownObjects& known, const PlacedFrame& placed,
                                                       const std::optional<PlacedScan>& scan);

  common::JobRunner& jobs_;
  common::LaserConfig laser_;
  std::shared_ptr<perception::KnownObjects> known_;  ///< Belongs to the job while one is outstanding.
  perception::ObjectTracker tracker_;
  FrameQueue frames_;
  std::deque<std::shared_ptr<const common::LaserScan>> scans_;  ///< The newest, without the beams of the mirror.
  std::map<int, Said> said_;                                    ///< What was reported of each, by id.
  common::EventLog& log_;
};

}  // namespace swiftlet::autonomy
