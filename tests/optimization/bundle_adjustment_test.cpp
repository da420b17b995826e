// Bundle adjustment recovers what it is given exactly, and reduces the error of what is noisy.
#include "optimization/bundle_adjustment.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "common/random.hpp"

namespace swiftlet::optimization {
namespace {

using common::Pose3;

struct Scene {
  Bundle truth;
  Bundle guess;  ///< The first two poses are right.
};

Eigen::Vector3d noise(common::RandomStream& random, double sigma) {
  return {random.gaussian(sigma), random.gaussian(sigma), random.gaussian(sigma)};
}

/// Six poses in a row that see forty landmarks in front of them.
Scene scene(std::uint64_t seed, double sigma_m) {
  common::RandomStream random(seed, "bundle");
  Scene scene;
  Bundle& truth = scene.truth;
  truth.fixed = {0, 1};
  for (int i = 0; i < 6; ++i)
    truth.poses.push_back({common::expSO3({0.0, 0.02 * i, 0.05 * i}), {0.1 * i, 0.05 * i, 0.02 * i}});
  for (int i = 0; i < 40; ++i) truth.landmarks_m.push_back(Eigen::Vector3d(3.0, 0.0, 0.0) + noise(random, 0.7));
  for (int pose = 0; pose < 6; ++pose)
    for (int landmark = 0; landmark < 40; ++landmark) {
      const Pose3 T_pose_map = truth.poses[static_cast<std::size_t>(pose)].inverse();
      const Eigen::Vector3d exact_m = T_pose_map * truth.landmarks_m[static_cast<std::size_t>(landmark)];
      // Depths err more than directions.
      const Eigen::Vector3d sigmas_m(3.0 * sigma_m, sigma_m, sigma_m);
      const Eigen::Vector3d error_m = sigmas_m.cwiseProduct(noise(random, 1.0));
      const Eigen::Vector3d variances_m2 = (sigma_m > 0.0 ? sigmas_m : Eigen::Vector3d(0.03, 0.01, 0.01)).cwiseAbs2();
      truth.observations.push_back({pose, landmark, exact_m + error_m, variances_m2.asDiagonal()});
    }
  scene.guess = truth;
  for (std::size_t i = 2; i < 6; ++i) {
    Pose3& pose = scene.guess.poses[i];
    pose = pose * Pose3{common::expSO3(noise(random, 0.02)), noise(random, 0.05)};
  }
  for (Eigen::Vector3d& landmark_m : scene.guess.landmarks_m) landmark_m += noise(random, 0.05);
  return scene;
}

double greatestError_m(const Bundle& bundle, const Bundle& truth) {
  double greatest_m = 0.0;
  for (std::size_t i = 0; i < truth.poses.size(); ++i)
    greatest_m = std::max(greatest_m, (bundle.poses[i].position_m - truth.poses[i].position_m).norm());
  return greatest_m;
}

TEST(BundleAdjustment, RecoversPosesAndLandmarksOfExactObservations) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Scene exact = scene(seed, 0.0);
    Bundle bundle = exact.guess;
    EXPECT_GT(greatestError_m(bundle, exact.truth), 0.02);
    adjust(bundle, {});
    EXPECT_LT(greatestError_m(bundle, exact.truth), 1e-4) << seed;
    EXPECT_LT((bundle.landmarks_m.front() - exact.truth.landmarks_m.front()).norm(), 1e-4) << seed;
  }
}

TEST(BundleAdjustment, ReducesTheErrorOfNoisyObservations) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Scene noisy = scene(seed, 0.01);
    Bundle bundle = noisy.guess;
    adjust(bundle, {});
    EXPECT_LT(squaredError(bundle), squaredError(noisy.truth)) << seed;
    EXPECT_LT(squaredError(bundle), 0.2 * squaredError(noisy.guess)) << seed;
    EXPECT_LT(greatestError_m(bundle, noisy.truth), 0.5 * greatestError_m(noisy.guess, noisy.truth)) << seed;
    EXPECT_EQ(bundle.poses[1].position_m, noisy.truth.poses[1].position_m);
  }
}

TEST(BundleAdjustment, AMeasuredPoseHoldsABundleThatFloats) {
  const Scene exact = scene(3, 0.0);
  Bundle bundle = exact.guess;
  bundle.fixed = {};
  for (int pose = 0; pose < 6; ++pose)
    bundle.measured.push_back({pose, exact.truth.poses[static_cast<std::size_t>(pose)], 1e4 * Matrix6d::Identity()});
  adjust(bundle, {});
  EXPECT_LT(greatestError_m(bundle, exact.truth), 1e-4);
}

TEST(BundleAdjustment, EqualBundlesGiveEqualBits) {
  Bundle one = scene(7, 0.01).guess, other = scene(7, 0.01).guess;
  adjust(one, {});
  adjust(other, {});
  for (std::size_t i = 0; i < one.poses.size(); ++i) {
    EXPECT_EQ(one.poses[i].position_m, other.poses[i].position_m);
    EXPECT_EQ(one.poses[i].rotation.coeffs(), other.poses[i].rotation.coeffs());
  }
  EXPECT_EQ(one.landmarks_m, other.landmarks_m);
}

}  // namespace
}  // namespace swiftlet::optimization
