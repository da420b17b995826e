// The image in groups of pixels, against the camera's own projection.
#include <gtest/gtest.h>

#include "mapping3d/voxels/pixel_groups.hpp"

namespace swiftlet::mapping3d {
namespace {

TEST(PixelGroups, APointIsInTheGroupOfItsPixel) {
  const common::PinholeCamera camera{319, 240, 280.0, 281.0, 160.3, 119.1};
  for (const int side : {1, 2}) {
    const PixelGroups groups(camera, side);
    EXPECT_EQ(groups.width, side == 1 ? 319 : 160) << "the last column of groups has one column of pixels";
    EXPECT_EQ(groups.height, 240 / side);
    for (const double u_px : {0.0, 17.0, 318.0})
      for (const double v_px : {0.0, 99.0, 239.0}) {
        const Eigen::Vector3f point = camera.point_camera_m(u_px, v_px, 2.5).cast<float>();
        const float u = groups.cu - groups.fu * point.y() / point.x();
        const float v = groups.cv - groups.fv * point.z() / point.x();
        EXPECT_NEAR(u, (u_px + 0.5) / side, 1e-3);
        EXPECT_NEAR(v, (v_px + 0.5) / side, 1e-3);
      }
    EXPECT_NEAR(groups.first_ray.x(), 0.5 / side, 1e-6);
    EXPECT_NEAR(groups.last_ray.x(), 318.5 / side, 1e-4);
    EXPECT_NEAR(groups.last_ray.y(), 239.5 / side, 1e-4);
  }
}

}  // namespace
}  // namespace swiftlet::mapping3d
