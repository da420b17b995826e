// A flight around a square corridor with an odometry that has errors of heading and scale: a loop to close.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "perception/projection/scan_projection.hpp"
#include "tests/scan_matching/planar_world.hpp"
#include "tests/slam2d/flight.hpp"

namespace swiftlet::test {

/// A square corridor with niches, 112 m around, flown with an odometry that has errors of heading and scale.
class Ring {
 public:
  Ring() {
    world_.addPolyline({{-2.0, -2.0}, {32.0, -2.0}, {32.0, 28.0}, {-2.0, 28.0}}, true);
    world_.addPolyline({{2.0, 2.0}, {28.0, 2.0}, {28.0, 24.0}, {2.0, 24.0}}, true);
    common::RandomStream random(11, "niches");
    for (int i = 0; i < 26; ++i) {
      world_.addBox(random.uniform(2.0, 28.0), -1.9, random.uniform(0.3, 1.2), random.uniform(0.3, 1.4));
      world_.addBox(31.9, random.uniform(0.0, 26.0), random.uniform(0.3, 1.4), random.uniform(0.3, 1.2));
      world_.addBox(random.uniform(0.0, 30.0), 27.9, random.uniform(0.3, 1.2), random.uniform(0.3, 1.4));
      world_.addBox(-1.9, random.uniform(2.0, 24.0), random.uniform(0.3, 1.4), random.uniform(0.3, 1.2));
    }
    laser_.beams = 541;
    laser_.rate_hz = 4.0;
    laser_.range_max_m = 12.0;
  }

  const PlanarWorld& world() const { return world_; }

  /// Calls each(scan, T_odom_body, covariance, truth) for `loops` rounds; the true start is the origin.
  template <typename Each>
  void fly(double loops, Each&& each, double stretch = 1.006, double bend_rad_m = 0.0003) const {
    std::vector<Eigen::Vector2d> corners{{0.0, 0.0}};
    for (int i = 0; i < static_cast<int>(std::ceil(loops)); ++i)
      for (const auto& c : {Eigen::Vector2d(30.0, 0.0), Eigen::Vector2d(30.0, 26.0), Eigen::Vector2d(0.0, 26.0),
                            Eigen::Vector2d(0.0, 0.0)})
        corners.push_back(c);
    const SmoothPath path(corners, 1.0);
    const common::Pose2 start = common::planar(path.at(common::Time{}));
    common::Pose2 T_odom_body, last_truth;
    const auto frames = static_cast<std::uint64_t>(loops * 112.0 * laser_.rate_hz);
    for (std::uint64_t frame = 0; frame < frames; ++frame) {
      const auto begin = common::Time::fromSeconds(static_cast<double>(frame) / laser_.rate_hz);
      const common::Pose2 truth = start.inverse() * common::planar(path.at(begin));
      common::Pose2 step = last_truth.inverse() * truth;
      step.x_m *= stretch;
      step.yaw_rad += bend_rad_m * step.position_m().norm();
      T_odom_body = frame == 0 ? truth : T_odom_body * step;
      last_truth = truth;
      common::RandomStream random(13, "ring", frame);
      common::LaserConfig still = laser_;
      still.sweep_s = 0.0;
      const common::LaserScan raw = sweep(
          world_, still, [&](common::Time) { return common::lifted(start * truth, 1.0); }, begin, random);
      const auto predicted = [&](common::Time) { return common::lifted(T_odom_body, 1.0); };
      const Eigen::Matrix3d covariance = Eigen::Vector3d(1e-5, 1e-5, 1e-6).asDiagonal();
      each(perception::project(raw, laser_, predicted, {}), T_odom_body, covariance, truth);
    }
  }

 private:
  PlanarWorld world_;
  common::LaserConfig laser_;
};

}  // namespace swiftlet::test
