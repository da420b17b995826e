// Tracks a pose that was found or given: by the odometry, and by particles that are weighted and resampled at intervals
// (Grzonka 2009, section V-C). Private to localization.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "perception/localization/localization_input.hpp"
#include "perception/localization/localizer_config.hpp"
#include "perception/localization/map_field.hpp"
#include "perception/localization/odometer.hpp"
#include "perception/localization/particle_filter.hpp"

namespace swiftlet::perception {

/// Deterministic. Not thread-safe.
class PoseTracker {
 public:
  PoseTracker(const std::shared_ptr<const MapField>& map, const LocalizerConfig& config, std::uint64_t seed);

  /// Applies the odometry since the last input, with its errors. The first input defines where the odometry starts.
  void advance(const LocalizationInput& input);
  bool begun() const { return odometer_.begun(); }

  /// Starts at a given pose with particles around it. The pose is only approximate until the particles are weighted.
  void startAt(const PoseHypothesis& given);
  bool onlyGiven() const { return only_given_; }
  /// Sets a pose that was found. The particles must already be around it.
  void placeAt(const common::Pose2& T_grid_odom, const Eigen::Matrix3d& covariance);

  /// Whether the distance or the turn since the last generation makes a new one due at that pose.
  bool generationDue(const common::Pose2& T_odom_body) const;
  void countGenerationsFromHere();
  /// One generation: moves, weighs and resamples the particles, and takes their mean as the pose.
  void generate(const ProjectedScan& scan);

  const common::Pose2& T_grid_odom() const { return T_grid_odom_; }
  common::Pose2 T_grid_body() const { return T_grid_odom_ * T_odom_body_; }
  /// Covariance of the present pose, including the odometry since the last generation; along the axes of the grid.
  Eigen::Matrix3d covariance() const;

  const common::Pose2& T_odom_body() const { return T_odom_body_; }
  double path_length_m() const { return odometer_.path_length_m(); }  ///< Travelled, according to the odometry.

  ParticleFilter& particles() { return filter_; }

 private:
  LocalizerConfig config_;
  ParticleFilter filter_;
  bool only_given_ = false;
  std::optional<PoseHypothesis> start_;  ///< A start pose that was given before the first odometry.

  common::Pose2 T_odom_body_;
  Odometer odometer_;
  double generation_path_length_m_ = 0.0, generation_turned_rad_ = 0.0;  ///< Odometer readings at the last generation.

  common::Pose2 T_grid_odom_;
  common::Pose2 T_odom_generation_;                       ///< Odometry pose at which the particles are.
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();  ///< Covariance of the particles.
  /// Covariance of the odometry since the last generation, along the axes of the body at that time.
  Eigen::Matrix3d step_covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace swiftlet::perception
