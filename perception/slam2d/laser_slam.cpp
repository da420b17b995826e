#include "perception/slam2d/laser_slam.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "perception/slam2d/scan_clock.hpp"

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

/// Unlike a vehicle with inertial sensors, nothing else tells where a robot in a corridor is: its motion is known
/// worse, and how well each scan holds it must be known better.
LaserSlamConfig::LaserSlamConfig() {
  odometry.max_window_m = 1.0;
  odometry.max_window_deg = 60.0;
  odometry.min_widened_quality = 0.45;
  odometry.widened_must_hold = true;
  odometry.max_failures = 4;
  odometry.min_fit = 0.55;
  odometry.min_weak_overlap = 0.93;
  odometry.matcher.guess_weight = 0.01;  // The prediction has its say in the filter.
  for (CorrelativeMatcherConfig* matcher : {&odometry.matcher, &slam.matcher}) matcher->profile_half_m = 1.0;
  // Read off the drift of intel, fr079 and csail without loops: a window must hold the truth.
  slam.edge_sigma_m = 0.01;
  slam.edge_sigma_deg = 0.15;
  slam.loops.min_window_m = 1.5;
  slam.loops.min_window_deg = 15.0;
  slam.loops.max_sigma_m = 10.0;
  slam.loops.max_window_deg = 180.0;
  slam.loops.min_fine_quality = 0.45;  // The query's own scans are tied less well than those of a flight.
  slam.live_map = false;               // Nobody flies by it.
}

void LaserSlamConfig::describe(common::config::Fields& fields) {
  fields.section("odometry", odometry, "Matching of each scan to those just before.");
  fields.section("slam", slam, "Key scans, loops and the map.");
  fields.section("motion", motion, "Prediction of the next step.");
}

std::vector<std::string> LaserSlamConfig::validate() const { return {}; }

struct LaserSlam::Impl {
  explicit Impl(const LaserSlamConfig& config_in)
      : config(config_in), motion(config_in.motion), odometry(config_in.odometry), slam(config_in.slam) {}

  ProjectedScan levelScan(const LaserSlamInput& input, common::Time now, const Pose2& T_odom_robot) const;
  Eigen::Matrix3d follow(const std::optional<RelativePose>& relative, const Pose2& before,
                         const Eigen::Matrix3d& covariance_before);

  LaserSlamConfig config;
  MotionPrediction motion;
  LaserOdometry odometry;
  Slam2d slam;
  ScanClock clock;
  LaserSlamCounts counts;

  bool begun = false;
  common::Time last_time;
  Pose2 T_odom_robot;                   ///< odom: the frame of the laser odometry; continuous.
  Pose2 T_odom_reference;               ///< Of the scan that the odometry measures from.
  std::optional<Pose2> T_odom_matched;  ///< At the last match.
};

ProjectedScan LaserSlam::Impl::levelScan(const LaserSlamInput& input, common::Time now, const Pose2& pose) const {
  common::LaserConfig laser;
  laser.mirror_beams = 0;
  laser.mount.x_m = input.T_robot_laser.x_m;
  laser.mount.y_m = input.T_robot_laser.y_m;
  laser.mount.yaw_deg = input.T_robot_laser.yaw_rad / common::kRadPerDeg;
  common::LaserScan scan = input.scan;
  scan.stamps = {now, now};
  return project(scan, laser, [&](common::Time) { return common::lifted(pose, 1.0); }, {});
}

/// Takes the match in and says how uncertain the step from the scan before is, with the axes of the robot there. A
/// match is relative to the odometry's reference: what it is uncertain of does not add up from scan to scan, only what
/// the uncertainty has grown by counts.
Eigen::Matrix3d LaserSlam::Impl::follow(const std::optional<RelativePose>& relative, const Pose2& before,
                                        const Eigen::Matrix3d& covariance_before) {
  const bool restarted = relative && relative->from == relative->to;
  if (!relative || (begun && restarted))
    motion.lose(config.odometry.max_window_m, config.odometry.max_window_deg * common::kRadPerDeg);
  else if (!restarted)
    motion.correct(relative->T_from_to, relative->covariance, relative->unseen_direction);
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

LaserSlam::LaserSlam(const LaserSlamConfig& config) : impl_(std::make_unique<Impl>(config)) {}
LaserSlam::~LaserSlam() = default;

std::optional<TrackedScan> LaserSlam::add(const LaserSlamInput& input) {
  Impl& self = *impl_;
  const common::Time now = self.clock.tick(input.scan.stamps.measured);
  self.counts.doubtful_stamps = self.clock.doubtful();
  const double elapsed_s = self.begun ? (now - self.last_time).seconds() : 0.0;
  self.last_time = now;
  const Pose2 before = self.motion.T_reference_robot();
  const Eigen::Matrix3d covariance_before = self.motion.covariance();
  if (!self.begun)
    self.motion.begin(input.T_odom_robot);
  else
    self.motion.predict(input.T_odom_robot, elapsed_s);
  const ProjectedScan scan = self.levelScan(input, now, self.T_odom_reference * self.motion.T_reference_robot());
  const auto relative = self.odometry.add(
      scan, self.T_odom_matched,
      SearchWindow{kWindowSigmas * self.motion.stepSigma_m(), kWindowSigmas * self.motion.stepSigma_rad()});
  if (!self.begun && !relative) {
    ++self.counts.empty_scans;
    return std::nullopt;
  }
  const Eigen::Matrix3d covariance = self.follow(relative, before, covariance_before);
  self.begun = true;
  self.slam.addScan(scan, self.T_odom_robot, covariance);
  if (const auto task = self.slam.takeTask()) self.slam.apply(run(*task));
  return TrackedScan{self.slam.anchor(), self.slam.T_anchor_body(), relative.has_value()};
}

void LaserSlam::finish() {
  if (const auto task = impl_->slam.takeLastTask()) impl_->slam.apply(run(*task));
}

std::vector<Pose2> LaserSlam::keyPoses() const {
  std::vector<Pose2> poses;
  for (const Slam2d::KeyPose& key : impl_->slam.keyPoses()) poses.push_back(key.T_map_body);
  return poses;
}

common::OccupancyGrid LaserSlam::map() { return impl_->slam.snapshot(); }
const Slam2d& LaserSlam::slam() const { return impl_->slam; }
const LaserOdometryCounts& LaserSlam::odometryCounts() const { return impl_->odometry.counts(); }
const LaserSlamCounts& LaserSlam::counts() const { return impl_->counts; }

}  // namespace swiftlet::perception
