// The particles: how many there are, how they move, how they are resampled.
#include <cmath>

#include <gtest/gtest.h>

#include "perception/localization/particle_filter.hpp"
#include "tests/localization/buildings.hpp"
#include "tests/localization/fields.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;
using test::fieldOf;
using test::pointsAt;

TEST(ParticleFilter, DrawsAsManyParticlesAsTheSpreadRequires) {
  const test::Building building = test::offices(6);
  ParticleFilter filter(fieldOf(building), ParticleFilterConfig{}, 1);
  filter.spreadOverFreeSpace();
  EXPECT_EQ(filter.size(), 5000U);
  const PoseHypothesis here{{5.0, 0.0, 0.3}, Eigen::Vector3d(1e-3, 1e-3, 1e-4).asDiagonal(), 1.0};
  filter.spreadAround(std::span(&here, 1));
  filter.resample();
  EXPECT_LE(filter.size(), 700U);
  EXPECT_GE(filter.size(), 500U);
}

/// The mean and spread of resampled particles are those of the weighted ones.
TEST(ParticleFilter, ResamplingKeepsMeanAndSpread) {
  const test::Building building = test::offices(7);
  for (const bool adaptive : {false, true}) {
    ParticleFilterConfig config;
    config.adaptive = adaptive;
    ParticleFilter filter(fieldOf(building), config, 2);
    const PoseHypothesis here{{5.0, 0.0, 3.1}, Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal(), 1.0};
    filter.spreadAround(std::span(&here, 1));
    filter.weigh(pointsAt(building, {5.05, 0.1, 3.12}));
    const auto before = filter.estimate();
    filter.resample();
    const auto after = filter.estimate();
    EXPECT_NEAR((before.T_grid_body.position_m() - after.T_grid_body.position_m()).norm(), 0.0, 0.01);
    EXPECT_NEAR(common::wrapAngle(before.T_grid_body.yaw_rad - after.T_grid_body.yaw_rad), 0.0, 0.005);
    EXPECT_NEAR(std::sqrt(after.covariance(0, 0) / before.covariance(0, 0)), 1.0, 0.15);
  }
}

TEST(ParticleFilter, MovesByTheGivenMotionAndNoise) {
  ParticleFilter filter(fieldOf(test::offices(8)), ParticleFilterConfig{}, 3);
  const PoseHypothesis here{{5.0, 0.0, 0.5}, Eigen::Matrix3d::Zero(), 1.0};
  filter.spreadAround(std::span(&here, 1));
  Eigen::Matrix3d covariance = Eigen::Vector3d(0.01, 0.0025, 0.0004).asDiagonal();
  covariance(0, 1) = covariance(1, 0) = 0.002;
  filter.move({0.4, 0.1, 0.2}, covariance);
  const Pose2 expected = Pose2{5.0, 0.0, 0.5} * Pose2{0.4, 0.1, 0.2};
  const auto estimate = filter.estimate();
  EXPECT_NEAR(estimate.T_grid_body.x_m, expected.x_m, 0.005);
  EXPECT_NEAR(estimate.T_grid_body.y_m, expected.y_m, 0.005);
  EXPECT_NEAR(estimate.T_grid_body.yaw_rad, expected.yaw_rad, 0.001);
  EXPECT_LT((estimate.covariance - common::turned(covariance, 0.5)).cwiseAbs().maxCoeff(), 6e-4);
}

TEST(ParticleFilter, TheSameSeedGivesTheSameParticlesOnEveryInstructionSet) {
  const test::Building building = test::offices(9);
  const auto field = fieldOf(building);
  std::vector<Pose2> first;
  for (const Instructions instructions : {Instructions::kScalar, Instructions::kSse41, Instructions::kAvx2}) {
    if (!isAvailable(instructions)) continue;
    ParticleFilter filter(field, ParticleFilterConfig{}, 4, instructions);
    filter.spreadOverFreeSpace();
    for (int i = 0; i < 5; ++i) {
      filter.move({0.2, 0.0, 0.05}, Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal());
      filter.weigh(pointsAt(building, {4.0 + 0.2 * i, 0.0, 0.05 * i}));
      filter.resample();
    }
    std::vector<Pose2> all;
    for (std::size_t i = 0; i < filter.size(); ++i) all.push_back(filter.particle(i));
    if (first.empty()) first = all;
    ASSERT_EQ(first.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      ASSERT_EQ(first[i].x_m, all[i].x_m);
      ASSERT_EQ(first[i].yaw_rad, all[i].yaw_rad);
    }
  }
}

}  // namespace
}  // namespace swiftlet::perception
