#include "benchmarks/floors/floor_drive.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/random.hpp"
#include "tests/slam2d/smoothed.hpp"

namespace swiftlet::benchmarks {
namespace {

using common::Pose2;
using common::Time;
using Eigen::Vector2d;

constexpr double kStep_m = 0.12;
constexpr double kStep_s = 0.2;
constexpr int kHalfCorner_steps = 12;  ///< Corners are rounded over so many to either side.
constexpr double kWeave_m = 0.25;
constexpr double kWeave_radPerM = 0.35;

constexpr int kBeams = 180;
constexpr double kHeight_m = 1.0;
constexpr double kRangeMax_m = 81.0;
constexpr double kNothing_m = 81.83;
constexpr double kNoise_m = 0.012;
constexpr double kLost = 0.002;

/// The directions of travel, one for each point of the line.
std::vector<Vector2d> directions(const std::vector<Vector2d>& line) {
  std::vector<Vector2d> result;
  for (std::size_t i = 0; i < line.size(); ++i)
    result.push_back((line[std::min(i + 1, line.size() - 1)] - line[i == 0 ? 0 : i - 1]).normalized());
  return result;
}

/// A point every step, from corner to corner in straight lines.
std::vector<Vector2d> stepsAlong(const std::vector<Vector2d>& corners) {
  std::vector<Vector2d> steps;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vector2d leg = corners[i + 1] - corners[i];
    for (double at_m = 0.0; at_m < leg.norm(); at_m += kStep_m) steps.push_back(corners[i] + leg.normalized() * at_m);
  }
  return steps;
}

/// Corners rounded, and weaving from side to side as a driver does.
std::vector<Pose2> posesAlong(const std::vector<Vector2d>& corners, common::RandomStream& random) {
  std::vector<Vector2d> line = test::smoothed(stepsAlong(corners), kHalfCorner_steps);
  const std::vector<Vector2d> straight = directions(line);
  const double phase_rad = random.uniform(0.0, 6.0);
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double aside_m = kWeave_m * std::sin(kWeave_radPerM * kStep_m * static_cast<double>(i) + phase_rad);
    line[i] += aside_m * Vector2d(-straight[i].y(), straight[i].x());
  }
  const std::vector<Vector2d> ahead = directions(line);
  std::vector<Pose2> poses;
  for (std::size_t i = 0; i < line.size(); ++i)
    poses.push_back({line[i].x(), line[i].y(), std::atan2(ahead[i].y(), ahead[i].x())});
  return poses;
}

common::LaserScan scanFrom(const Pose2& pose, Time stamp, const test::PlanarWorld& world,
                           common::RandomStream& random) {
  common::LaserScan scan;
  scan.stamps = {stamp, stamp};
  scan.angle_increment_rad = common::kRadPerDeg;
  scan.angle_min_rad = -0.5 * kBeams * scan.angle_increment_rad;
  scan.range_min_m = 0.02;
  scan.range_max_m = kRangeMax_m;
  for (int beam = 0; beam < kBeams; ++beam) {
    const double yaw_rad = pose.yaw_rad + scan.angle_min_rad + beam * scan.angle_increment_rad;
    const double range_m = world.cast({pose.x_m, pose.y_m, kHeight_m}, {std::cos(yaw_rad), std::sin(yaw_rad), 0.0});
    const double noise_m = random.gaussian(kNoise_m);
    const bool found = range_m < kRangeMax_m && !random.chance(kLost);
    scan.ranges_m.push_back(static_cast<float>(found ? std::max(scan.range_min_m, range_m + noise_m) : kNothing_m));
  }
  return scan;
}

/// Errors of the wheels: some are constant, some new with every step.
class Wheels {
 public:
  explicit Wheels(std::uint64_t seed)
      : random_(seed, "wheels"), scale_(1.0 + random_.gaussian(0.01)), bias_radPerM_(random_.gaussian(0.002)) {}

  Pose2 counted(const Pose2& step) {
    const double corners_m = step.position_m().norm();
    return {scale_ * step.x_m + random_.gaussian(0.01 * corners_m + 1e-4),
            step.y_m + random_.gaussian(0.005 * corners_m),
            1.01 * step.yaw_rad + bias_radPerM_ * corners_m +
                random_.gaussian(0.01 * corners_m + 0.02 * std::abs(step.yaw_rad))};
  }

 private:
  common::RandomStream random_;
  double scale_;
  double bias_radPerM_;
};

}  // namespace

FloorDrive makeFloorDrive(const FloorPlan& plan, std::uint64_t seed) {
  common::RandomStream driver(seed, "driver");
  common::RandomStream laser(seed, "laser");
  Wheels wheels(seed);
  FloorDrive drive;
  Pose2 T_odom_robot;
  std::optional<Pose2> last;
  for (const Pose2& pose : posesAlong(plan.corners_m, driver)) {
    if (last) T_odom_robot = T_odom_robot * wheels.counted(common::between(*last, pose));
    last = pose;
    const Time stamp = Time::fromSeconds(kStep_s * static_cast<double>(drive.scans.size() + 1));
    drive.truth.push_back({stamp, common::lifted(pose, 0.0)});
    drive.scans.push_back({scanFrom(pose, stamp, plan.world, laser), T_odom_robot});
  }
  return drive;
}

}  // namespace swiftlet::benchmarks
