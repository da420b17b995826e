// Parts of the odometry, each against what is known exactly.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"
#include "mapping3d/odometry/surface_fit.hpp"
#include "tests/rgbd_odometry/textured_room.hpp"
#include "vision/point_registration.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;
using vision::rigidTransform;

TEST(SurfaceFit, OfAWallHasItsNormalAndIsLessNoisyThanItsPixels) {
  const TexturedRoom room;
  const Pose3 pose{common::quaternionFrom({0.0, 0.1, 0.35}), {0.2, -0.1, 0.1}};
  const common::RgbdFrame frame = room.seen(pose, 0.0);
  TexturedRoom exact = room;
  exact.noise_per_m2 = 0.0;
  const common::RgbdFrame truth = exact.seen(pose, 0.0);
  double raw_m2 = 0.0, fitted_m2 = 0.0;
  int count = 0;
  for (int v = 100; v < 140; v += 6)
    for (int u = 120; u < 200; u += 6) {
      const auto fit = fitSurface(frame.depth, frame.camera, u, v, 5, {});
      if (!fit) continue;
      ++count;
      const Eigen::Vector3d normal_map = pose.rotation * fit->normal_camera;
      EXPECT_GT(normal_map.cwiseAbs().maxCoeff(), std::cos(8.0 * common::kRadPerDeg)) << u << ", " << v;
      const auto true_m = static_cast<double>(truth.depth.at(u, v));
      raw_m2 += std::pow(static_cast<double>(frame.depth.at(u, v)) - true_m, 2);
      fitted_m2 += std::pow(fit->depth_m - true_m, 2);
    }
  EXPECT_GT(count, 70);
  EXPECT_LT(fitted_m2, raw_m2 / 25.0);
}

TEST(SurfaceFit, NoneAcrossAnEdge) {
  common::DepthImage depth{21, 21, std::vector<float>(21 * 21, 1.0F)};
  for (int v = 0; v < 21; ++v)
    for (int u = 11; u < 21; ++u) depth.depth_m[static_cast<std::size_t>(v * 21 + u)] = 1.5F;
  const common::PinholeCamera camera{21, 21, 250.0, 250.0, 10.0, 10.0};
  EXPECT_FALSE(fitSurface(depth, camera, 10, 10, 4, {}));
  EXPECT_TRUE(fitSurface(depth, camera, 5, 10, 4, {}));
}

std::vector<DescribedPoint> randomPoints(int count, common::RandomStream& random) {
  std::vector<DescribedPoint> points(static_cast<std::size_t>(count));
  for (DescribedPoint& point : points) {
    point.point_camera_m = {random.uniform(1.0, 3.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    for (std::uint64_t& bits : point.descriptor.bits) bits = random.bits();
  }
  return points;
}

TEST(PointRegistration, FindsThePoseAmongTwoThirdsOfWrongPairs) {
  common::RandomStream random(5, "points");
  const Pose3 T_a_b{common::expSO3({0.2, -0.3, 0.4}), {0.1, 0.2, -0.1}};
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    const std::vector<DescribedPoint> b = randomPoints(90, random);
    std::vector<DescribedPoint> a = b;
    for (std::size_t i = 0; i < a.size(); ++i)
      a[i].point_camera_m = i % 3 == 0 ? T_a_b * b[i].point_camera_m
                                       : Eigen::Vector3d(random.uniform(1.0, 3.0), random.uniform(-1.0, 1.0), 0.0);
    const auto found = registerPoints(a, b, trial);
    ASSERT_TRUE(found) << trial;
    EXPECT_LT((found->position_m - T_a_b.position_m).norm(), 0.02);
  }
}

TEST(PointRegistration, NoneBetweenUnrelatedPoints) {
  common::RandomStream random(6, "points");
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    const std::vector<DescribedPoint> b = randomPoints(90, random);
    std::vector<DescribedPoint> a = randomPoints(90, random);
    EXPECT_FALSE(registerPoints(a, b, trial));
    for (std::size_t i = 0; i < a.size(); ++i) a[i].descriptor = b[i].descriptor;  // Alike, but at other places.
    EXPECT_FALSE(registerPoints(a, b, trial));
  }
}

TEST(RigidTransform, RecoversAnyPose) {
  common::RandomStream random(8, "poses");
  for (int trial = 0; trial < 50; ++trial) {
    const auto vector = [&](double size) {
      return Eigen::Vector3d(random.gaussian(size), random.gaussian(size), random.gaussian(size));
    };
    const Pose3 pose{common::expSO3(vector(1.0)), vector(2.0)};
    std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> pairs;
    for (int i = 0; i < 3 + trial % 4; ++i) {
      const Eigen::Vector3d b = vector(1.0);
      pairs.emplace_back(pose * b, b);
    }
    const Pose3 found = rigidTransform(pairs);
    EXPECT_LT((found.position_m - pose.position_m).norm(), 1e-9);
    EXPECT_LT(found.rotation.angularDistance(pose.rotation), 1e-7);
  }
}

}  // namespace
}  // namespace swiftlet::mapping3d
