// Slopes of the ground: seen by a depth camera, added up along a path, and what they save the height from.
#include "perception/altitude/ground_slopes.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "common/random.hpp"
#include "tests/altitude/staircase_world.hpp"

namespace swiftlet::perception {
namespace {

using Heights = std::function<double(const Eigen::Vector2d&)>;

constexpr double kRamp = 0.176;  // 10 degrees.

common::Pose3 cameraAt(double x_m, double height_m, double pitch_deg) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(pitch_deg * common::kRadPerDeg, Eigen::Vector3d::UnitY())),
          {x_m, 0.2, height_m}};
}

/// What a camera sees of a ground of these heights, with the noise of a structured-light camera.
common::DepthImage imageOf(const Heights& heights_m, const common::PinholeCamera& camera,
                           const common::Pose3& T_map_camera, std::uint64_t seed) {
  common::RandomStream random(seed, "depth");
  common::DepthImage depth{camera.width_px, camera.height_px, {}};
  for (int v = 0; v < camera.height_px; ++v)
    for (int u = 0; u < camera.width_px; ++u) {
      if (u % 3 != 1 || v % 3 != 1) {  // Not looked at.
        depth.depth_m.push_back(common::DepthImage::kUnknown);
        continue;
      }
      double depth_m = 0.8;
      const auto point = [&] { return Eigen::Vector3d(T_map_camera * camera.point_camera_m(u, v, depth_m)); };
      while (depth_m < 6.0 && point().z() > heights_m(point().head<2>())) depth_m += 0.01;
      depth_m += random.gaussian(0.0014 * depth_m * depth_m);
      depth.depth_m.push_back(depth_m < 6.0 ? static_cast<float>(depth_m) : common::DepthImage::kTooFar);
    }
  return depth;
}

class Ground : public testing::Test {
 protected:
  /// Three images on the way, whose poses have an attitude that is wrong by that much.
  void see(const Heights& heights_m, double attitude_error_deg = 0.0) {
    const common::PinholeCamera camera{320, 240, 288.0, 288.0, 159.5, 119.5};
    for (int i = 0; i < 3; ++i)
      slopes_.add(imageOf(heights_m, camera, cameraAt(0.1 * i, 1.5, 20.0), 7 + static_cast<std::uint64_t>(i)), camera,
                  cameraAt(0.1 * i, 1.5, 20.0 + attitude_error_deg));
  }
  GroundSlopes slopes_;
};

TEST_F(Ground, LevelGroundIsLevelAlsoWithAnAttitudeThatIsWrongByADegree) {
  see([](const Eigen::Vector2d&) { return 0.0; }, 1.5);
  EXPECT_EQ(slopes_.gradientAt({2.6, 0.2}), Eigen::Vector2d(0.0, 0.0));
  EXPECT_FALSE(slopes_.gradientAt({-2.0, 0.2})) << "behind the camera";
}

TEST_F(Ground, ARampIsSeenWhereItIs) {
  see([](const Eigen::Vector2d& at) { return std::max(0.0, kRamp * (at.x() - 2.4)); });
  EXPECT_EQ(slopes_.gradientAt({2.0, 0.2}), Eigen::Vector2d(0.0, 0.0));
  const auto ramp = slopes_.gradientAt({3.0, 0.2});
  ASSERT_TRUE(ramp);
  EXPECT_NEAR(ramp->x(), kRamp, 0.02);
  EXPECT_NEAR(ramp->y(), 0.0, 0.03);
}

/// A loop closure turns the map by 90 degrees: east becomes north, and so does the way up.
TEST_F(Ground, ARampMovesAndTurnsWithTheKeyScanItHangsOn) {
  common::KeyPoses keys{1, {{{}, common::Pose2{}}}};
  slopes_.follow(keys, 0);
  see([](const Eigen::Vector2d& at) { return std::max(0.0, kRamp * (at.x() - 2.4)); });
  keys.version = 2;
  keys.keys[0].T_map_key = {1.0, 0.0, 0.5 * std::numbers::pi};
  slopes_.follow(keys, 0);
  const auto ramp = slopes_.gradientAt(keys.keys[0].T_map_key * Eigen::Vector2d(3.0, 0.2));
  ASSERT_TRUE(ramp);
  EXPECT_NEAR(ramp->x(), 0.0, 0.03);
  EXPECT_NEAR(ramp->y(), kRamp, 0.02);
  EXPECT_FALSE(slopes_.gradientAt({3.0, 0.2})) << "where it was";
}

TEST_F(Ground, AStepIsNoSlope) {
  see([](const Eigen::Vector2d& at) { return at.x() > 2.6 ? 0.3 : 0.0; });
  const auto beside = slopes_.gradientAt({2.6, 0.2});
  EXPECT_TRUE(!beside || beside->isZero());
  EXPECT_EQ(slopes_.gradientAt({3.0, 0.2}), Eigen::Vector2d(0.0, 0.0)) << "the top";
}

/// Up a ramp of 1 m, over a landing, down, and back, eight seeds. The gradients are wrong by a third of a degree.
double worstOverARamp_m(bool sees_slopes) {
  double worst_m = 0.0;
  for (int seed = 1; seed <= 8; ++seed) {
    Overflight flight;
    flight.sees_slopes = sees_slopes;
    flight.gradient_error = seed % 2 == 0 ? 0.006 : -0.006;
    flight.random = common::RandomStream(static_cast<std::uint64_t>(seed), "ramp");
    flight.acceleration_bias_m_s2 = flight.random.uniform(-0.02, 0.02);
    flight.boxes = {{3.0, 8.7, -2.0, 2.0, 0.0, 1.0}, {8.7, 11.7, -2.0, 2.0, 1.0}, {11.7, 17.4, -2.0, 2.0, 1.0, 0.0}};
    flight.start();
    flight.climbTo(1.8);
    flight.flyTo({21.0, 0.0}, 0.7);
    flight.flyTo({0.0, 0.0}, 0.7);
    worst_m = std::max(worst_m, flight.worst_error_m);
  }
  return worst_m;
}

TEST(Ramp, TheHeightIsKnownOverItAndBetterWhereACameraSawIt) {
  EXPECT_LT(worstOverARamp_m(false), 0.2);
  EXPECT_LT(worstOverARamp_m(true), 0.15);
}

/// The worst error of the height at the end of ten flights over that, without a camera.
double worstAtTheEnd_m(const std::vector<Box>& boxes) {
  double worst_m = 0.0;
  for (int seed = 1; seed <= 10; ++seed) {
    Overflight flight;
    flight.random = common::RandomStream(static_cast<std::uint64_t>(seed), "doubt");
    flight.acceleration_bias_m_s2 = flight.random.uniform(-0.02, 0.02);
    flight.boxes = boxes;
    flight.start();
    flight.climbTo(1.8);
    flight.flyTo({20.0, 0.0}, 0.7);
    worst_m = std::max(worst_m, std::abs(flight.filter.state().height_m - flight.z_m));
  }
  return worst_m;
}

TEST(MultilevelFilter, KnowsTheHeightBehindARampThatNothingTellsItOf) {
  EXPECT_LT(worstAtTheEnd_m({{3.0, 8.7, -2.0, 2.0, 0.0, 1.0}, {8.7, 20.5, -2.0, 2.0, 1.0}}), 0.15) << "10 degrees up";
  EXPECT_LT(worstAtTheEnd_m({{3.0, 8.7, -2.0, 2.0, 1.0, 0.0}}), 0.05) << "a step up, 10 degrees down to the floor";
  EXPECT_LT(worstAtTheEnd_m({}), 0.02);
  EXPECT_LT(worstAtTheEnd_m({{3.0, 3.8, -2, 2, 0.75}, {5.0, 5.4, -2, 2, 0.45}, {7.0, 7.9, -2, 2, 0.72}}), 0.02);
  EXPECT_LT(worstAtTheEnd_m({{9.0, 9.3, -2, 2, 1.04}, {9.3, 9.6, -2, 2, 1.04, 0.45}, {9.6, 10.1, -2, 2, 0.45}}), 0.02)
      << "a sofa";
}

}  // namespace
}  // namespace swiftlet::perception
