#include "benchmarks/peers/mrpt_peers.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include <mrpt/config/CConfigFile.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/random.h>
#include <mrpt/slam/CMetricMapBuilderICP.h>
#include <mrpt/slam/CMetricMapBuilderRBPF.h>

namespace swiftlet::peers {
namespace {

using common::Pose2;
using interfaces::LoggedScan;

constexpr const char* kSection = "MappingApplication";

mrpt::poses::CPose2D toMrpt(const Pose2& pose) { return {pose.x_m, pose.y_m, pose.yaw_rad}; }

mrpt::obs::CObservation2DRangeScan::Ptr scanOf(const LoggedScan& logged) {
  const common::LaserScan& scan = logged.scan;
  auto observation = mrpt::obs::CObservation2DRangeScan::Create();
  observation->timestamp = mrpt::Clock::fromDouble(scan.stamps.measured.seconds());
  observation->sensorLabel = "LASER";
  const std::size_t beams = scan.ranges_m.size();
  // Its fans are symmetrical: what ours is not stands in the mount.
  const double fan_rad = scan.angle_increment_rad * (static_cast<double>(beams) - 1.0);
  const Pose2 T_robot_fan = logged.T_robot_laser * Pose2{0.0, 0.0, scan.angle_min_rad + 0.5 * fan_rad};
  observation->sensorPose = mrpt::poses::CPose3D(T_robot_fan.x_m, T_robot_fan.y_m, 0.0, T_robot_fan.yaw_rad);
  observation->aperture = static_cast<float>(fan_rad);
  observation->maxRange = static_cast<float>(scan.range_max_m);
  observation->resizeScan(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    const float range_m = scan.ranges_m[i];
    const bool valid = std::isfinite(range_m) && range_m >= static_cast<float>(scan.range_min_m);
    observation->setScanRange(i, valid ? range_m : observation->maxRange);
    observation->setScanRangeValidity(i, valid);
  }
  return observation;
}

template <typename Builder>
Pose2 estimateOf(const Builder& builder) {
  const mrpt::poses::CPose3D mean = builder.getCurrentPoseEstimation()->getMeanVal();
  return {mean.x(), mean.y(), mean.yaw()};
}

class IcpSlam final : public Peer {
 public:
  explicit IcpSlam(const std::filesystem::path& settings) {
    const mrpt::config::CConfigFile file(settings.string());
    builder_.ICP_options.loadFromConfigFile(file, kSection);
    builder_.ICP_params.loadFromConfigFile(file, "ICP");
    builder_.setMinLoggingLevel(mrpt::system::LVL_ERROR);
    builder_.initialize();
  }

  void add(const LoggedScan& logged) override {
    const auto scan = scanOf(logged);
    if (logged.T_odom_robot) {
      auto odometry = mrpt::obs::CObservationOdometry::Create();
      odometry->timestamp = scan->timestamp;
      odometry->odometry = toMrpt(*logged.T_odom_robot);
      builder_.processObservation(odometry);
    }
    builder_.processObservation(scan);
    poses_.push_back(estimateOf(builder_));
  }

  std::vector<Pose2> finish() override { return poses_; }

 private:
  mrpt::slam::CMetricMapBuilderICP builder_;
  std::vector<Pose2> poses_;
};

class RbpfSlam final : public Peer {
 public:
  explicit RbpfSlam(const std::filesystem::path& settings) {
    mrpt::random::getRandomGenerator().randomize(1);
    const mrpt::config::CConfigFile file(settings.string());
    mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions options;
    options.loadFromConfigFile(file, kSection);
    options.verbosity_level = mrpt::system::LVL_ERROR;
    builder_ = std::make_unique<mrpt::slam::CMetricMapBuilderRBPF>(options);
    builder_->setMinLoggingLevel(mrpt::system::LVL_ERROR);
  }

  void add(const LoggedScan& logged) override {
    const Pose2 T_odom_robot = logged.T_odom_robot.value_or(Pose2{});
    if (steps_.empty()) T_odom_last_ = T_odom_path_ = T_odom_robot;
    mrpt::obs::CActionRobotMovement2D movement;
    movement.computeFromOdometry(toMrpt(T_odom_last_.inverse() * T_odom_robot), {});
    T_odom_last_ = T_odom_robot;
    mrpt::obs::CActionCollection actions;
    actions.insert(movement);
    mrpt::obs::CSensoryFrame frame;
    frame.insert(scanOf(logged));
    builder_->processActionObservation(actions, frame);
    rememberStep(T_odom_robot);
  }

  /// Along the path of the particle that is the best in the end.
  std::vector<Pose2> finish() override {
    std::deque<mrpt::math::TPose3D> path;
    builder_->getCurrentMostLikelyPath(path);
    std::vector<Pose2> poses;
    for (const Step& step : steps_) {
      const mrpt::math::TPose3D& at = path.at(std::min(step.path_index, path.size() - 1));
      poses.push_back(Pose2{at.x, at.y, at.yaw} * step.T_path_robot);
    }
    return poses;
  }

 private:
  struct Step {
    std::size_t path_index = 0;
    Pose2 T_path_robot;  ///< Since that pose of the path, by the odometry.
  };

  /// The path grows by a pose where the filter was updated; between, the odometry leads on.
  void rememberStep(const Pose2& T_odom_robot) {
    const std::size_t poses = builder_->mapPDF.m_particles.front().d->robotPath.size();
    if (poses != path_poses_) T_odom_path_ = T_odom_robot;
    path_poses_ = poses;
    steps_.push_back({poses == 0 ? 0 : poses - 1, T_odom_path_.inverse() * T_odom_robot});
  }

  std::unique_ptr<mrpt::slam::CMetricMapBuilderRBPF> builder_;
  std::vector<Step> steps_;
  std::size_t path_poses_ = 0;
  Pose2 T_odom_last_, T_odom_path_;
};

}  // namespace

std::unique_ptr<Peer> mrptIcpSlam(const std::filesystem::path& settings) { return std::make_unique<IcpSlam>(settings); }
std::unique_ptr<Peer> mrptRbpfSlam(const std::filesystem::path& settings) {
  return std::make_unique<RbpfSlam>(settings);
}

}  // namespace swiftlet::peers
