// What `swiftlet map3d` keeps of the frames that it has mapped.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/trajectory.hpp"
#include "mapping3d/model/mapper3d.hpp"
#include "mapping3d/odometry/recorded_seeds.hpp"
#include "rendering/thinned_curve.hpp"

namespace swiftlet::apps {

/// A frame relative to a key frame, so that later loop closures move it.
struct TrackedFrame {
  common::Time stamp;
  int scan = 0;
  common::Pose3 T_scan_camera;
};

/// The first tracked frame that has a given pose: it hangs the map into the world of the given poses.
struct WorldAnchor {
  std::size_t tracked = 0;  ///< Index of the frame among the tracked ones.
  common::Pose3 T_world_camera;
};

struct Map3dRun {
  explicit Map3dRun(const mapping3d::Mapper3dConfig& mapper_config) : config(mapper_config), mapper(config) {}

  mapping3d::Mapper3dConfig config;
  mapping3d::Mapper3d mapper;
  std::vector<TrackedFrame> tracked;
  std::optional<WorldAnchor> anchor;
  common::Trajectory given;  ///< Poses of the recorder's camera from other sensors.
  std::optional<mapping3d::SeedDisagreement> disagreement_of_given;
  std::uint64_t with_pose = 0;  ///< Frames with a given pose of their time.
  rendering::ThinnedCurve milliseconds, disagreement;
  std::vector<double> frame_ms;
  std::vector<double> depths_m;  ///< Median depths of some of the frames.
  std::uint64_t frames = 0, lost = 0, found_again = 0, key_frames = 0, loops = 0;
  std::uint64_t lost_in_a_row = 0;  ///< Up to the newest frame.
  std::uint64_t before = 0;         ///< Frames before the one that the map begins with.
  std::size_t triangles = 0;        ///< Of the mesh; 0 if none was made.
  double wall_s = 0.0;

  /// Whether the few frames tracked so far are of a place that the camera does not come back to, at this time.
  bool isFalseStart(common::Time now) const {
    if (!given.empty() || tracked.empty() || lost_in_a_row < kFalseStartFrames) return false;
    const double lost_s = (now - tracked.back().stamp).seconds();
    const double tracked_s = (tracked.back().stamp - tracked.front().stamp).seconds();
    return lost_s >= kFalseStart_s && lost_s >= kFalseStartRatio * tracked_s;
  }

  /// Forgets the map; the next frame begins another.
  void beginAnew() {
    mapper = mapping3d::Mapper3d(config);
    tracked.clear();
    before = frames;
    lost = lost_in_a_row = found_again = key_frames = loops = 0;
  }

  double medianMs() const { return medianOf(frame_ms); }
  double medianDepth_m() const { return medianOf(depths_m); }

 private:
  static constexpr std::uint64_t kFalseStartFrames = 15;
  static constexpr double kFalseStart_s = 3.0;
  static constexpr double kFalseStartRatio = 3.0;  ///< Lost this many times longer than it was tracked.

  /// 0 of an empty list.
  static double medianOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[values.size() / 2];
  }
};

}  // namespace swiftlet::apps
