// Estimates the height over the take-off floor and the surfaces below from the mirror beams of a scan.
//
//   depth image --> gradients of the ground, in the map --> rise of the slope below
//                                                              |
//   mirror beams --> points below, in the map ---------------> + --> levels --> virtual height --> AltitudeStep
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "common/geometry.hpp"
#include "common/key_pose.hpp"
#include "common/level_map.hpp"
#include "common/time.hpp"
#include "perception/altitude/fan_ground.hpp"
#include "perception/altitude/ground_slopes.hpp"
#include "perception/altitude/multilevel_filter.hpp"
#include "perception/altitude/seen_surfaces.hpp"
#include "perception/fusion/error_state_filter.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::autonomy {

/// Vertical distance from the body down to the surface below: the median of the mirror beams; nullopt without them.
std::optional<double> medianBelow_m(const perception::ProjectedScan& scan);

/// The height information of one scan.
struct AltitudeStep {
  std::optional<double> below_m;                      ///< The raw measurement: medianBelow_m of the scan.
  std::optional<perception::VerticalState> vertical;  ///< For the filter; none if nothing was below.
  int levels_joined = 0;
  std::optional<double> floor_regained_m;    ///< See perception::AltitudeUpdate.
  std::optional<double> slope_ended_rise_m;  ///< A slope has ended; the ground is higher by this behind it.
};

/// One thread.
class AltitudePipeline {
 public:
  AltitudePipeline(const perception::MultilevelFilter::Config& config, double hull_radius_m);

  /// Starts with the vehicle standing at the origin of the map, and its body `height_m` above the take-off floor.
  void initialize(common::Time time, double height_m);

  /// Call it with the key scans of the map before what is added next: what was seen of the ground moves with them.
  void follow(const common::KeyPoses& keys, int newest_key) {
    seen_.follow(keys, newest_key);
    slopes_.follow(keys, newest_key);
  }

  /// Whether the slopes of the ground are to be learned from an image of that time: a few images a second show each
  /// place several times.
  bool wantsGround(common::Time time) const { return (time - looked_at_ground_).seconds() >= kGroundPeriod_s; }
  /// Learns how the ground slopes from a depth image and the pose of its camera.
  void lookAtGround(common::Time time, const common::DepthImage& depth, const common::PinholeCamera& camera,
                    const common::Pose3& T_map_camera) {
    looked_at_ground_ = time;
    slopes_.add(depth, camera, T_map_camera);
  }

  /// Makes floor hits of the beams that ended on a slope ahead.
  void removeGround(perception::ProjectedScan& scan) const { fan_.remove(scan); }

  /// `vertical` is what the filter knows at the scan's stamp, with the climb since lastScan(); without it the scan does
  /// not change the levels. `at_rest`: the vehicle stands.
  AltitudeStep add(const perception::ProjectedScan& scan, const common::Pose2& T_map_odom,
                   const common::Pose2& T_odom_body, const std::optional<perception::VerticalMotion>& vertical,
                   bool at_rest);
  /// Stamp of the last scan, or of the start.
  common::Time lastScan() const { return last_scan_; }

  /// Height of the surface directly below, table or floor, over the take-off floor, at the last scan that saw it; zero
  /// before the first.
  double surfaceHeight_m() const { return surface_height_m_; }
  /// Every surface that was seen, also those that are no level.
  common::LevelMap seenSurfaces() const { return seen_.surfaces(); }
  /// Never null; the same object until a level changes.
  std::shared_ptr<const common::LevelMap> levels();

 private:
  std::optional<double> followSlope(bool slopes, const Eigen::Vector2d& place_odom_m);

  static constexpr double kGroundPeriod_s = 0.2;

  perception::MultilevelFilter filter_;
  perception::SeenSurfaces seen_;
  perception::GroundSlopes slopes_;
  perception::FanGround fan_;
  struct SlopeBegin {
    Eigen::Vector2d place_odom_m;
    double height_m;  ///< Of the ground.
  };
  std::optional<SlopeBegin> slope_;
  double hull_radius_m_;
  double surface_height_m_ = 0.0;
  common::Time looked_at_ground_;
  common::Time last_scan_;
  std::uint64_t published_version_ = 0;
  std::shared_ptr<const common::LevelMap> published_;
};

}  // namespace swiftlet::autonomy
