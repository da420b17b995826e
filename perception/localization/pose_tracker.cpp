#include "perception/localization/pose_tracker.hpp"

#include <cmath>

#include "common/square.hpp"
#include "perception/laser_odometry/unknown_step.hpp"

namespace swiftlet::perception {

using common::kRadPerDeg;
using common::Pose2;
using common::square;

namespace {

/// Turn after which the particles are weighted and resampled.
constexpr double kGenerationTurn_deg = 15.0;
/// Least error of the odometry's heading for each metre.
constexpr double kOdometryDegPer_m = 0.5;

/// Least noise of a particle step. Without noise, resampled copies of a particle would never separate.
constexpr double kLeastNoise_m = 0.01;
constexpr double kLeastNoise_rad = 0.2 * kRadPerDeg;
/// Least error of the odometry's heading, as a share of the turn.
constexpr double kTurnShare = 0.02;

}  // namespace

PoseTracker::PoseTracker(const std::shared_ptr<const MapField>& map, const LocalizerConfig& config, std::uint64_t seed)
    : config_(config), filter_(map, config.particles, seed) {}

void PoseTracker::advance(const LocalizationInput& input) {
  const bool first = !begun();
  odometer_.add(input.T_odom_body);
  if (first) {
    T_odom_body_ = T_odom_generation_ = input.T_odom_body;
    if (!start_) return;
    T_grid_odom_ = start_->T_grid_body * T_odom_body_.inverse();
    start_.reset();
    return;
  }
  const Pose2 moved = between(T_odom_body_, input.T_odom_body);
  const double distance_m = moved.position_m().norm(), turn_rad = std::abs(common::wrapAngle(moved.yaw_rad));
  const Eigen::Vector3d least(square(config_.odometry_share * distance_m), square(config_.odometry_share * distance_m),
                              square(kOdometryDegPer_m * kRadPerDeg * distance_m) + square(kTurnShare * turn_rad));
  Eigen::Matrix3d measured = input.step_covariance;
  if (input.interrupted) measured += unknownStepCovariance();
  const Eigen::Matrix3d own =
      common::turned(measured + Eigen::Matrix3d(least.asDiagonal()), between(T_odom_generation_, T_odom_body_).yaw_rad);
  step_covariance_ = common::propagated(step_covariance_, between(T_odom_generation_, T_odom_body_),
                                        between(T_odom_generation_, input.T_odom_body), own);
  T_odom_body_ = input.T_odom_body;
}

void PoseTracker::startAt(const PoseHypothesis& given) {
  filter_.spreadAround(std::span(&given, 1));
  covariance_ = given.covariance;
  only_given_ = true;
  if (begun())
    placeAt(given.T_grid_body * T_odom_body_.inverse(), given.covariance);
  else
    start_ = given;
}

void PoseTracker::placeAt(const Pose2& T_grid_odom, const Eigen::Matrix3d& covariance) {
  T_grid_odom_ = T_grid_odom;
  covariance_ = covariance;
  T_odom_generation_ = T_odom_body_;
  step_covariance_.setZero();
}

bool PoseTracker::generationDue(const Pose2& next_T_odom_body) const {
  return only_given_ ||
         odometer_.path_length_m(next_T_odom_body) - generation_path_length_m_ >= config_.generation_distance_m ||
         odometer_.turned_rad(next_T_odom_body) - generation_turned_rad_ >= kGenerationTurn_deg * kRadPerDeg;
}

void PoseTracker::countGenerationsFromHere() {
  generation_path_length_m_ = odometer_.path_length_m();
  generation_turned_rad_ = odometer_.turned_rad();
}

void PoseTracker::generate(const ProjectedScan& scan) {
  const Eigen::Vector3d least(square(kLeastNoise_m), square(kLeastNoise_m), square(kLeastNoise_rad));
  filter_.move(between(T_odom_generation_, T_odom_body_), step_covariance_ + Eigen::Matrix3d(least.asDiagonal()));
  filter_.weigh(scan.points_level_m);
  filter_.resample();
  const PoseHypothesis estimate = filter_.estimate();
  placeAt(estimate.T_grid_body * T_odom_body_.inverse(), estimate.covariance);
  countGenerationsFromHere();
  only_given_ = false;
}

Eigen::Matrix3d PoseTracker::covariance() const {
  const Pose2 T_grid_generation = T_grid_odom_ * T_odom_generation_;
  return propagated(covariance_, T_grid_generation, T_grid_odom_ * T_odom_body_,
                    common::turned(step_covariance_, T_grid_generation.yaw_rad));
}

}  // namespace swiftlet::perception
