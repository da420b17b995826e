// Follows a pose once it is found or given: by the odometry, and by particles that are weighed and drawn anew now and
// then (Grzonka 2009, section V-C). Private to localization.
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

  /// Odometry since the last input, with its errors. The first input says where the odometry begins.
  void advance(const LocalizationInput& input);
  bool begun() const { return way_.begun(); }

  /// The pose is believed to be this one, with particles about it. It is only roughly right until they are weighed.
  void startAt(const PoseHypothesis& given);
  bool onlyGiven() const { return only_given_; }
  /// The pose was found; the particles are there.
  void placeAt(const common::Pose2& T_grid_odom, const Eigen::Matrix3d& covariance);

  /// Whether way or turn since the last generation would ask for one at that pose.
  bool generationDue(const common::Pose2& T_odom_body) const;
  void countGenerationsFromHere();
  /// Predict, weigh, draw anew, take the mean.
  void generate(const ProjectedScan& scan);

  const common::Pose2& T_grid_odom() const { return T_grid_odom_; }
  common::Pose2 T_grid_body() const { return T_grid_odom_ * T_odom_body_; }
  /// Of the pose that the odometry has led to since the particles were drawn; axes of the grid.
  Eigen::Matrix3d covariance() const;

  const common::Pose2& T_odom_body() const { return T_odom_body_; }
  double path_length_m() const { return way_.path_length_m(); }  ///< Travelled, by the odometry.

  ParticleFilter& particles() { return filter_; }

 private:
  LocalizerConfig config_;
  ParticleFilter filter_;
  bool only_given_ = false;
  std::optional<PoseHypothesis> start_;  ///< Given before the odometry began.

  common::Pose2 T_odom_body_;
  Odometer way_;
  double generation_path_length_m_ = 0.0, generation_turned_rad_ = 0.0;  ///< At the last generation.

  common::Pose2 T_grid_odom_;
  common::Pose2 T_odom_generation_;                            ///< Where the particles are,
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();       ///< and how far spread.
  Eigen::Matrix3d step_covariance_ = Eigen::Matrix3d::Zero();  ///< Since then, axes of the body then.
};

}  // namespace swiftlet::perception
