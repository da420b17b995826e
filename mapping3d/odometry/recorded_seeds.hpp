// Poses of the camera from other sensors, as a file has them, and how good they are. Their noise and lateness are not
// given, so they are compared with the track: over the steps between frames whose pose is measured in all
// directions.
//
//   poses --> read later by the lateness --> steps --> spread against the tracked steps, each axis of the map by itself
//
// A step of a seed then counts as much as its spread allows (withSeedStep). Seeds that know the vertical well and the
// heading badly keep what they know, because the axes are those of their own map. Deterministic; one thread.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "common/trajectory.hpp"
#include "mapping3d/odometry/rgbd_odometry.hpp"

namespace swiftlet::mapping3d {

/// How far the poses and the track are apart at the end of stretches at whose begin they agree. Medians.
struct SeedDisagreement {
  double stretch_s = 0.0;  ///< A second, or half of what was tracked if that is less.
  double error_m = 0.0, error_rad = 0.0;
  double motion_m = 0.0, motion_rad = 0.0;  ///< What the track moved in a stretch.

  /// Far more than noise and jumps of good poses: the track and the poses are not of the same motion.
  bool isContradiction() const;
};

class RecordedSeeds {
 public:
  /// Between poses farther apart, no motion is assumed.
  static constexpr double kLongestGap_s = 0.5;

  /// `poses` are those of the camera (axes of `camera`), in a map with z upwards if they know the vertical.
  explicit RecordedSeeds(common::Trajectory poses) : poses_(std::move(poses)) {}

  /// The seed at a frame's time, between two poses at most kLongestGap_s apart; nullopt elsewhere.
  std::optional<CameraSeed> at(common::Time stamp) const;
  /// Learns from a frame that was placed. Frames come in the order of their stamps.
  void compare(const RgbdPose& pose);

  /// How late the poses are, by their stamps. 0 until it is known.
  double lateness_s() const { return lateness_s_; }
  /// Of the last tracked frames; nullopt if they are too few.
  std::optional<SeedDisagreement> disagreement() const;

 private:
  struct Tracked {
    common::Time stamp;
    common::Pose3 T_map_camera;
  };
  /// Both are the poses at the end of a stretch, in the axes of those at its begin.
  struct Stretch {
    common::Pose3 tracked, seed;
  };
  std::optional<common::Pose3> poseAt(common::Time stamp, double lateness_s) const;
  std::vector<Stretch> stretches(const std::deque<Tracked>& frames, double length_s, double lateness_s) const;
  std::optional<double> misfit(double lateness_s) const;
  void learnLateness();
  void learnSpread();

  common::Trajectory poses_;
  std::deque<Tracked> tracked_;  ///< The last frames that were certain of their pose.
  std::deque<Tracked> judged_;   ///< The last frames, certain or not.
  std::uint64_t compared_ = 0;
  double lateness_s_ = 0.0;
  std::optional<Matrix6d> rate_covariance_;
};

}  // namespace swiftlet::mapping3d
