#include "perception/slam2d/laser_track.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>

namespace swiftlet::perception {
namespace {

using common::Pose2;

/// How wide to search, in sigmas of the prediction.
constexpr double kWindowSigmas = 4.0;

/// The part of a symmetric matrix that is positive.
Eigen::Matrix3d positivePart(const Eigen::Matrix3d& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(matrix);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

const Pose2& LaserTrack::predict(const common::Stamps& stamps, const std::optional<Pose2>& T_odom_robot) {
  const common::Time last = now_;
  now_ = clock_.tick(stamps.measured);
  before_ = motion_.T_reference_robot();
  covariance_before_ = motion_.covariance();
  if (begun_)
    motion_.predict(T_odom_robot, (now_ - last).seconds());
  else
    motion_.begin(T_odom_robot);
  predicted_T_odom_robot_ = T_odom_reference_ * motion_.T_reference_robot();
  return predicted_T_odom_robot_;
}

ProjectedScan LaserTrack::levelScan(const common::LaserScan& raw, const Pose2& T_robot_laser) const {
  common::LaserConfig laser;
  laser.mirror_beams = 0;
  laser.mount.x_m = T_robot_laser.x_m;
  laser.mount.y_m = T_robot_laser.y_m;
  laser.mount.yaw_deg = T_robot_laser.yaw_rad / common::kRadPerDeg;
  common::LaserScan scan = raw;
  scan.stamps = {now_, now_};
  return project(scan, laser, [&](common::Time) { return common::lifted(predicted_T_odom_robot_, 1.0); }, {});
}

/// A match is relative to the odometry's reference: what it is uncertain of does not add up from scan to scan, only
/// what the uncertainty has grown by counts.
Eigen::Matrix3d LaserTrack::follow(const std::optional<RelativePose>& relative, bool lost) {
  if (lost)
    motion_.lose(config_.max_window_m, config_.max_window_deg * common::kRadPerDeg);
  else if (relative && relative->from != relative->to)
    motion_.correct(relative->T_from_to, relative->covariance, relative->unseen_direction);
  const Pose2 now = motion_.T_reference_robot();
  const Eigen::Matrix3d carried = propagated(covariance_before_, before_, now, Eigen::Matrix3d::Zero());
  const Eigen::Matrix3d grown = common::turned(positivePart(motion_.covariance() - carried), -before_.yaw_rad);
  T_odom_robot_ = T_odom_reference_ * now;
  if (!relative) return grown;
  if (relative->reference_changed) {
    T_odom_reference_ = T_odom_robot_;
    motion_.rebase();
  }
  T_odom_matched_ = T_odom_robot_;
  return grown;
}

std::optional<LaserTrackStep> LaserTrack::add(const common::LaserScan& raw, const Pose2& T_robot_laser, bool withheld) {
  LaserTrackStep step;
  step.scan = levelScan(raw, T_robot_laser);
  std::optional<RelativePose> relative;
  const bool offered = !withheld || !begun_;
  if (offered) {
    relative =
        odometry_.add(step.scan, T_odom_matched_,
                      SearchWindow{kWindowSigmas * motion_.stepSigma_m(), kWindowSigmas * motion_.stepSigma_rad()});
    if (!begun_ && !relative) return std::nullopt;
  }
  step.broken = begun_ && relative && relative->from == relative->to;
  step.matched = relative.has_value();
  begun_ = true;
  step.covariance = follow(relative, step.broken || (offered && !relative));
  step.T_odom_robot = T_odom_robot_;
  step.scan.T_odom_body = common::lifted(T_odom_robot_, 1.0);
  return step;
}

}  // namespace swiftlet::perception
