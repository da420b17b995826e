// Real inertial data: EuRoC V1_01 (hexarotor in a Vicon room). Laser odometry and height are made from its ground
// truth: 40 Hz, 20 ms late, 1 cm and 0.2 deg noise against a reference scan that changes every half second.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/fusion/synthetic_flight.hpp"
#include "tests/support/datasets.hpp"

namespace swiftlet::perception {
namespace {

namespace fs = std::filesystem;
using common::Duration;
using common::Time;

/// The lines of an .xz file, by xz.
std::vector<std::vector<double>> readNumbers(const fs::path& file) {
  std::vector<std::vector<double>> rows;
  const std::string command = "xz -dc '" + file.string() + "'";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) return rows;
  char line[1024];
  while (std::fgets(line, sizeof line, pipe.get())) {
    if (line[0] == '#') continue;
    std::vector<double> row;
    const char* at = line;
    char* end = nullptr;
    for (double x = std::strtod(at, &end); end != at; x = std::strtod(at, &end)) {
      row.push_back(x);
      at = end;
      while (*at == ',' || *at == ' ') ++at;
    }
    rows.push_back(row);
  }
  return rows;
}

struct Recording {
  std::vector<common::ImuSample> imu;
  std::vector<common::StampedPose> truth;  ///< Body FLU in a frame that starts at its first pose's position and yaw.
};

Recording read(const fs::path& folder) {
  Recording out;
  // Axes of the recording's IMU (x up, z forwards) to a body with x forwards and z up.
  Eigen::Matrix3d R_body_imu;
  R_body_imu << 0, 0, 1, 0, -1, 0, 1, 0, 0;
  const auto imu = readNumbers(folder / "V1_01_imu0.csv.xz");
  const auto poses = readNumbers(folder / "V1_01_groundtruth_200Hz_original.txt.xz");
  if (imu.empty() || poses.empty()) return out;
  const double epoch_s = 1403715273.0;
  for (const auto& row : imu) {
    common::ImuSample sample;
    // A double keeps such a stamp to a quarter of a microsecond.
    sample.stamps.measured = sample.stamps.arrived = Time::fromSeconds(row[0] * 1e-9 - epoch_s);
    sample.angular_velocity_body_rad_s = R_body_imu * Eigen::Vector3d(row[1], row[2], row[3]);
    sample.specific_force_body_m_s2 = R_body_imu * Eigen::Vector3d(row[4], row[5], row[6]);
    out.imu.push_back(sample);
  }
  for (const auto& row : poses) {
    if (row.size() < 8) continue;
    const Eigen::Quaterniond q_world_imu = Eigen::Quaterniond(row[7], row[4], row[5], row[6]).normalized();
    out.truth.push_back({Time::fromSeconds(row[0] - epoch_s),
                         {q_world_imu * Eigen::Quaterniond(Eigen::Matrix3d(R_body_imu.transpose())),
                          Eigen::Vector3d(row[1], row[2], row[3])}});
  }
  return out;
}

/// The recording's own data sheet, widened as for any real IMU.
ErrorStateFilter::Config configOfTheRecording() {
  ErrorStateFilter::Config config;
  config.use_ahrs = false;
  config.accelerometer_noise_m_s2_rthz = 0.02;
  config.gyroscope_noise_rad_s_rthz = 0.001;
  config.gravity_m_s2 = 9.81;
  config.accelerometer_bias_sigma_m_s2 = 0.2;
  return config;
}

/// The planar odometry and the heights that a scan matcher would give, made of the truth and noise.
class MadeUpScans {
 public:
  MadeUpScans(const PoseHistory& truth, Time started) : truth_(truth), started_(started), next_scan_(started) {}

  void addUntil(Time now, ErrorStateFilter& filter) {
    while (next_scan_ + Duration::fromMilliseconds(20) <= now) {
      const Time scan = next_scan_;
      next_scan_ += Duration::fromMilliseconds(25);
      const auto pose = truth_.at(scan);
      if (pose && scan > started_) add(scan, *pose, filter);
    }
  }

 private:
  static constexpr double kSigma_m = 0.01, kSigma_rad = 0.2 * std::numbers::pi / 180.0;

  void add(Time scan, const common::Pose3& pose, ErrorStateFilter& filter) {
    (void)filter.add(measuredHeight(scan, pose.position_m.z() + random_.gaussian(kSigma_m), kSigma_m * kSigma_m));
    if (reference_) {
      common::Pose2 relative = planar(*truth_.at(*reference_)).inverse() * planar(pose);
      relative.x_m += random_.gaussian(kSigma_m);
      relative.y_m += random_.gaussian(kSigma_m);
      relative.yaw_rad += random_.gaussian(kSigma_rad);
      const Eigen::Matrix3d covariance =
          Eigen::Vector3d(kSigma_m * kSigma_m, kSigma_m * kSigma_m, kSigma_rad * kSigma_rad).asDiagonal();
      EXPECT_EQ(filter.add(measuredRelativePose(*reference_, scan, relative, covariance)), Insertion::kTaken);
    }
    if (!reference_ || (scan - *reference_).seconds() >= 0.5) {
      (void)filter.add(poseClone(scan));
      reference_ = scan;
    }
  }

  const PoseHistory& truth_;
  Time started_;
  Time next_scan_;
  std::optional<Time> reference_;
  common::RandomStream random_{1, "euroc"};
};

/// Sums of squares of the estimate's errors.
struct Errors {
  double position2 = 0, velocity2 = 0, height2 = 0, relative2 = 0;
  int n = 0, relative_n = 0;
  std::optional<common::Pose3> estimate_before, truth_before;

  void add(const common::VehicleState& state, const common::Pose3& pose, const Eigen::Vector3d& velocity_world,
           const common::Pose2& T_odom_world) {
    const Eigen::Vector3d velocity_odom = lifted(T_odom_world, 0.0).rotation * velocity_world;
    const Eigen::Vector2d position_odom = T_odom_world * Eigen::Vector2d(pose.position_m.head<2>());
    position2 += (state.T_odom_body.position_m.head<2>() - position_odom).squaredNorm();
    height2 += std::pow(state.T_odom_body.position_m.z() - pose.position_m.z(), 2);
    // Velocities in the heading frame: the yaw drifts freely.
    const double yaw = common::yawOf(state.T_odom_body.rotation);
    const double true_yaw = common::yawOf(pose.rotation) + T_odom_world.yaw_rad;
    const Eigen::Vector3d a = common::lifted({0, 0, -yaw}, 0).rotation * state.velocity_odom_m_s;
    const Eigen::Vector3d b = common::lifted({0, 0, -true_yaw}, 0).rotation * velocity_odom;
    velocity2 += (a - b).squaredNorm();
    if (n % 200 == 0) {
      if (estimate_before) {
        const common::Pose2 moved = planar(*estimate_before).inverse() * planar(state.T_odom_body);
        const common::Pose2 should = planar(*truth_before).inverse() * planar(pose);
        relative2 += (moved.position_m() - should.position_m()).squaredNorm();
        ++relative_n;
      }
      estimate_before = state.T_odom_body;
      truth_before = pose;
    }
    ++n;
  }
};

TEST(Euroc, PlanarOdometryAndHeightKeepTheErrorOfARealFlightBounded) {
  const auto folder = test_support::dataSet("04-uav-logs/euroc-V1_01");
  if (!folder) return;
  const Recording recording = read(*folder);
  ASSERT_GT(recording.imu.size(), 20000u) << "xz is needed to read it";
  const PoseHistory truth(recording.truth);

  ErrorStateFilter filter(configOfTheRecording());
  common::Pose2 T_odom_world;
  Time started;
  std::optional<MadeUpScans> scans;
  Errors errors;
  for (const auto& sample : recording.imu) {
    const Time now = sample.stamps.measured;
    filter.predict(sample);
    const Duration aside = Duration::fromMilliseconds(10);
    if (filter.initialized() && !truth.covers(now + aside)) break;
    if (!truth.covers(now - aside)) continue;
    if (!filter.initialized()) {
      const auto pose = truth.at(now);
      if (!filter.initialize(pose->position_m.z())) continue;
      T_odom_world = planar(*pose).inverse();
      started = now;
      scans.emplace(truth, started);
    }
    scans->addUntil(now, filter);
    if ((now - started).seconds() < 3.0) continue;
    const Eigen::Vector3d velocity_world =
        (truth.at(now + aside)->position_m - truth.at(now - aside)->position_m) / 0.02;
    errors.add(filter.state(), *truth.at(now), velocity_world, T_odom_world);
  }
  const int n = errors.n;
  ASSERT_GT(n, 20000);
  const double position_m = std::sqrt(errors.position2 / n), velocity_m_s = std::sqrt(errors.velocity2 / n),
               height_m = std::sqrt(errors.height2 / n), relative_m = std::sqrt(errors.relative2 / errors.relative_n);
  std::printf(
      "EuRoC V1_01, %.0f s: drifting position %.3f m RMSE, over 1 s %.4f m, height %.4f m, velocity %.4f m/s; %s, "
      "gated %llu + %llu, %llu recoveries\n",
      n / 200.0, position_m, relative_m, height_m, velocity_m_s, filter.health().reason.c_str(),
      static_cast<unsigned long long>(filter.counts().relative_poses_gated),
      static_cast<unsigned long long>(filter.counts().heights_gated),
      static_cast<unsigned long long>(filter.counts().recoveries));
  EXPECT_EQ(filter.health().status, FusionStatus::kOk);
  EXPECT_EQ(filter.counts().recoveries, 0u);
  EXPECT_LT(relative_m, 0.02);
  EXPECT_LT(height_m, 0.01);
  EXPECT_LT(velocity_m_s, 0.05);
  EXPECT_LT(position_m, 0.40);  // 290 references, each worth 1 cm and 0.2 deg.
}

}  // namespace
}  // namespace swiftlet::perception
