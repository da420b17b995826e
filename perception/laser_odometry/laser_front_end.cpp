#include "perception/laser_odometry/laser_front_end.hpp"

#include <Eigen/Geometry>

#include "common/small_matrices.hpp"

#include "perception/laser_odometry/scan_clock.hpp"
#include "perception/laser_odometry/swept_projection.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

/// Half width of the search window, in sigmas of the prediction.
constexpr double kWindowSigmas = 4.0;

/// The positive semidefinite part of a symmetric matrix.
Eigen::Matrix3d positivePart(const Eigen::Matrix3d& matrix) {
  const common::SymmetricEigen<3> eigen = common::symmetricEigen(matrix);
  return eigen.vectors * eigen.values.cwiseMax(0.0).asDiagonal() * eigen.vectors.transpose();
}

/// A motion in the axes of the robot, turned into the axes of the reference.
std::optional<common::UnobservableMotion> atReference(const std::optional<common::UnobservableMotion>& motion_robot,
                                                      const Pose2& T_reference_robot) {
  if (!motion_robot) return std::nullopt;
  return common::turned(*motion_robot, T_reference_robot.yaw_rad);
}

/// The scan at the time `now` of the clock, with exactly its stamp.
ProjectedScan projected(const LaserSlamInput& input, common::Time now, const Pose2& T_odom_robot) {
  common::LaserScan stamped = input.scan;
  stamped.stamps = {now, now};
  if (input.motion != nullptr) return projectSwept(stamped, input.T_robot_laser, T_odom_robot, *input.motion);
  // All beams at one time.
  stamped.time_increment = {};
  return projectLevel(stamped, input.T_robot_laser, T_odom_robot);
}

}  // namespace

struct LaserFrontEnd::Impl {
  explicit Impl(const LaserFrontEndConfig& config_in)
      : config(config_in), motion(config_in.motion), odometry(config_in.odometry) {}

  std::optional<RelativePose> match(const ProjectedScan& scan);
  Eigen::Matrix3d follow(const std::optional<RelativePose>& relative, bool lost, const Pose2& before,
                         const Eigen::Matrix3d& covariance_before);

  LaserFrontEndConfig config;
  MotionPrediction motion;
  LaserOdometry odometry;
  ScanClock clock;

  bool begun = false;
  common::Time last_time;
  Pose2 T_odom_robot;
  Pose2 T_odom_reference;               ///< Of the key scan that the odometry is relative to.
  std::optional<Pose2> T_odom_matched;  ///< The pose at the last match.
};

std::optional<RelativePose> LaserFrontEnd::Impl::match(const ProjectedScan& scan) {
  std::optional<OtherGuess> other;
  if (const auto alternative = motion.alternative())
    other = {T_odom_reference * alternative->T_reference_robot,
             {kWindowSigmas * alternative->step_sigma_m, kWindowSigmas * alternative->step_sigma_rad}};
  const auto relative =
      odometry.add(scan, T_odom_matched,
                   SearchWindow{kWindowSigmas * motion.stepSigma_m(), kWindowSigmas * motion.stepSigma_rad()}, other);
  if (relative && relative->otherwise) motion.takeAlternative();
  return relative;
}

/// Takes in the match and returns the covariance of the step from the previous scan, in the axes of the robot there. A
/// match is relative to the reference of the odometry, so its errors do not add up from scan to scan. The step
/// therefore has only the covariance by which that of the pose has grown.
Eigen::Matrix3d LaserFrontEnd::Impl::follow(const std::optional<RelativePose>& relative, bool lost, const Pose2& before,
                                            const Eigen::Matrix3d& covariance_before) {
  if (lost)
    motion.lose(config.odometry.max_window_m, config.odometry.max_window_deg * common::kRadPerDeg);
  else if (relative && relative->from != relative->to)
    motion.correct(relative->T_from_to, relative->covariance,
                   atReference(relative->unobservable_motion, relative->T_from_to));
  const Pose2 now = motion.T_reference_robot();
  const Eigen::Matrix3d carried = propagated(covariance_before, before, now, Eigen::Matrix3d::Zero());
  Eigen::Matrix3d grown = common::turned(positivePart(motion.covariance() - carried), -before.yaw_rad);
  T_odom_robot = T_odom_reference * now;
  if (!relative) return grown;
  if (relative->reference_changed) {
    T_odom_reference = T_odom_robot;
    motion.rebase();
  }
  T_odom_matched = T_odom_robot;
  return grown;
}

LaserFrontEnd::LaserFrontEnd(const LaserFrontEndConfig& config) : impl_(std::make_unique<Impl>(config)) {}
LaserFrontEnd::~LaserFrontEnd() = default;

std::optional<FollowedScan> LaserFrontEnd::add(const LaserSlamInput& input, const Withhold& withhold) {
  Impl& self = *impl_;
  const common::Time now = self.clock.tick(input.scan.stamps.measured);
  const double elapsed_s = self.begun ? (now - self.last_time).seconds() : 0.0;
  self.last_time = now;
  const Pose2 before = self.motion.T_reference_robot();
  const Eigen::Matrix3d covariance_before = self.motion.covariance();
  if (!self.begun)
    self.motion.begin(input.T_odom_robot);
  else
    self.motion.predict(input.T_odom_robot, elapsed_s);
  const Pose2 expected = self.T_odom_reference * self.motion.T_reference_robot();

  FollowedScan followed;
  followed.scan = projected(input, now, expected);
  const bool withheld = withhold && withhold(expected) && self.begun;
  const std::optional<RelativePose> relative = withheld ? std::nullopt : self.match(followed.scan);
  if (!self.begun && !relative) return std::nullopt;
  followed.broken = self.begun && relative && relative->from == relative->to;
  followed.matched = relative && !followed.broken;
  const bool lost = followed.broken || (!withheld && !relative);
  followed.covariance_since_last = self.follow(relative, lost, before, covariance_before);
  followed.T_odom_robot = self.T_odom_robot;
  followed.T_expected_robot = between(expected, self.T_odom_robot);
  self.begun = true;
  return followed;
}

const LaserOdometryCounts& LaserFrontEnd::odometryCounts() const { return impl_->odometry.counts(); }

LaserSlamCounts LaserFrontEnd::counts() const { return {impl_->clock.unreliable(), impl_->motion.implausibleSteps()}; }

}  // namespace swiftlet::perception
