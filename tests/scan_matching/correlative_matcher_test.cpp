#include "perception/scan_matching/correlative_matcher.hpp"

#include <gtest/gtest.h>

#include "perception/projection/scan_projection.hpp"
#include "tests/scan_matching/planar_world.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;
using common::Time;

ProjectedScan scanAt(const test::PlanarWorld& world, const Pose2& pose, std::uint64_t frame,
                     common::LaserConfig laser = {}) {
  common::RandomStream random(7, "matcher_test", frame);
  laser.sweep_s = 0.0;
  const auto still = [&](Time) { return common::lifted(pose, 1.0); };
  const auto scan = test::sweep(world, laser, still, Time::fromSeconds(static_cast<double>(frame)), random);
  return project(scan, laser, still, {});
}

Pose2 randomPose(common::RandomStream& random) {
  return {random.uniform(-1.0, 2.5), random.uniform(-2.0, 2.0), random.uniform(-3.1, 3.1)};
}

TEST(CorrelativeMatcher, EqualsTheExhaustiveSearch) {
  const test::PlanarWorld world = test::flat();
  common::RandomStream random(3, "exhaustive");
  for (int trial = 0; trial < 40; ++trial) {
    CorrelativeMatcher matcher{{}};
    const Pose2 reference = randomPose(random);
    matcher.addReference(scanAt(world, reference, 2 * trial), reference);
    const Pose2 step{random.uniform(-0.08, 0.08), random.uniform(-0.08, 0.08), random.uniform(-0.01, 0.01)};
    const ProjectedScan scan = scanAt(world, reference * step, 2 * trial + 1);
    const SearchWindow window{random.uniform(0.0, 0.12), random.uniform(0.0, 0.02)};
    const MatchResult fast = matcher.match(scan, reference, window);
    const MatchResult slow = matcher.matchExhaustively(scan, reference, window);
    ASSERT_EQ(fast.finest_score, slow.finest_score) << trial;
    ASSERT_GT(fast.finest_score, 0);
  }
}

TEST(CorrelativeMatcher, Accuracy) {
  const test::PlanarWorld world = test::flat();
  common::RandomStream random(5, "accuracy");
  for (const auto estimate : {PoseEstimate::kFinest, PoseEstimate::kWeightedMean, PoseEstimate::kSurface}) {
    double sum2_t = 0, sum2_r = 0, nees = 0;
    int n = 0, failed = 0;
    double quality = 0;
    for (int trial = 0; trial < 300; ++trial) {
      CorrelativeMatcherConfig config;
      config.estimate = estimate;
      CorrelativeMatcher matcher{config};
      const Pose2 reference = randomPose(random);
      matcher.addReference(scanAt(world, reference, 2 * trial), reference);
      const Pose2 step{random.uniform(-0.08, 0.08), random.uniform(-0.08, 0.08), random.uniform(-0.01, 0.01)};
      const Pose2 truth = reference * step;
      const MatchResult m = matcher.match(scanAt(world, truth, 2 * trial + 1), reference, {0.1, 0.02});
      if (m.failed) {
        ++failed;
        continue;
      }
      Eigen::Vector3d e(m.T_reference_body.x_m - truth.x_m, m.T_reference_body.y_m - truth.y_m,
                        common::wrapAngle(m.T_reference_body.yaw_rad - truth.yaw_rad));
      sum2_t += e.head<2>().squaredNorm();
      sum2_r += e.z() * e.z();
      ++n;
      quality += m.quality;
      nees += e.dot(m.covariance.ldlt().solve(e));
    }
    printf("estimate %d: n %d failed %d rms %.2f mm %.4f deg nees %.2f quality %.2f\n", int(estimate), n, failed,
           1e3 * std::sqrt(sum2_t / n), std::sqrt(sum2_r / n) * 57.3, nees / n, quality / n);
  }
}

}  // namespace
}  // namespace swiftlet::perception
