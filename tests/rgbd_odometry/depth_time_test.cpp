// Depths that were not taken when the colours were.
#include <gtest/gtest.h>

#include <cmath>

#include "mapping3d/odometry/depth_time.hpp"
#include "tests/rgbd_odometry/textured_room.hpp"
#include "tests/rgbd_odometry/walk.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;

TEST(DepthTime, DepthsAreThoseThatTheColourWouldHave) {
  TexturedRoom room;
  room.noise_per_m2 = 0.0;
  const Pose3 color = walk(1.0), depth = color * Pose3{common::expSO3({0.01, -0.02, 0.03}), {0.02, -0.01, 0.01}};
  const common::RgbdFrame wanted = room.seen(color, 1.0), taken = room.seen(depth, 1.0);
  const common::DepthImage moved = depthFrom(taken.depth, taken.camera, color.inverse() * depth);
  int measured = 0, right = 0, right_before = 0;
  for (std::size_t i = 0; i < moved.depth_m.size(); ++i) {
    if (!common::isMeasured(moved.depth_m[i])) continue;
    ++measured;
    right += std::abs(moved.depth_m[i] - wanted.depth.depth_m[i]) < 0.01F ? 1 : 0;
    right_before += std::abs(taken.depth.depth_m[i] - wanted.depth.depth_m[i]) < 0.01F ? 1 : 0;
  }
  EXPECT_GT(measured, 0.9 * static_cast<double>(moved.depth_m.size())) << "what moved out of the view is not known";
  EXPECT_GT(right, 0.99 * measured);
  EXPECT_LT(right_before, 0.6 * measured) << "the motion matters";
}

}  // namespace
}  // namespace swiftlet::mapping3d
