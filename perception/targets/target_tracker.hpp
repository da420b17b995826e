// Follows targets from frame to frame, and places them in the map.
//
//   sightings --> to the frame of a key scan --> the target they belong to (Mahalanobis) --> Kalman update
//                                                    \--> none: a new candidate
//   candidate --seen from enough places--> found;  candidate --free-space violations--> dropped
//
// Each target is kept relative to a key scan of the 2D map, so a loop closure moves it along.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/key_pose.hpp"
#include "common/rgbd_frame.hpp"
#include "common/world/targets_layer.hpp"
#include "perception/targets/point_estimate.hpp"
#include "perception/targets/target_config.hpp"
#include "perception/targets/target_detector.hpp"

namespace swiftlet::perception {

/// The frame that shows the sightings, and where it was taken.
struct TargetView {
  const common::RgbdFrame& frame;
  int key = 0;                    ///< Index of the key scan that the pose refers to.
  common::Pose3 T_key_camera;     ///< In the level frame of that key scan.
  double position_sigma_m = 0.0;  ///< Of the camera's place in the map, beside the configured one.
  double turn_rate_rad_s = 0.0;   ///< Of the camera.
  const common::KeyPoses& keys;
};

/// One thread. The same frames in the same order give the same bits.
class TargetTracker {
 public:
  /// The camera reports what is beyond `range_m` as too far.
  TargetTracker(const TargetTrackerConfig& config, std::vector<TargetClassConfig> classes, double range_m);

  /// Sightings that are not finite are left out, and so is a view whose pose is not.
  void add(const std::vector<TargetSighting>& sightings, const TargetView& view);

  /// All targets in the map.
  std::vector<common::Target> targets(const common::KeyPoses& keys) const;

 private:
  struct Track {
    int id = 0, number = 0;
    std::uint8_t color = 0;
    int key = 0;
    PointEstimate place_key;  ///< In the level frame of that key scan, like the next.
    std::vector<Eigen::Vector3d> views_key_m;
    int views = 0;
    int misses = 0;
    double diameter_m = 0.0;
    bool seen_now = false;
  };
  PointMeasurement measurement(const TargetSighting& sighting, const TargetView& view, int key) const;
  Track* trackOf(const TargetSighting& sighting, const TargetView& view);
  void begin(const TargetSighting& sighting, const TargetView& view);
  void update(Track& track, const TargetSighting& sighting, const TargetView& view);
  void confirm(Track& track);
  void mergeDuplicates(const common::KeyPoses& keys);
  void dropViolated(const TargetView& view);

  TargetTrackerConfig config_;
  double range_m_;
  std::vector<TargetClassConfig> classes_;
  PointEstimate::SharedCovariance shared_;
  std::vector<Track> tracks_;  ///< In the order of their ids.
  int last_id_ = 0;
  std::vector<int> last_number_;  ///< By class.
};

}  // namespace swiftlet::perception
