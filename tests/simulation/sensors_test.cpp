#include <gtest/gtest.h>

#include <cmath>

#include "fixtures.hpp"
#include "laser_fixtures.hpp"
#include "simulation/sensors/camera.hpp"

namespace swiftlet::simulation {
namespace {

using common::Time;

TEST(LaserScanner, RangesEqualTheGeometryOfARoom) {
  LaserScanner laser(quietLaser(), 1);
  const RayCaster rays(boxRoom());
  const common::Pose3 pose{common::quaternionFrom({0, 0, 0.3}), {1, -1, 1}};
  const common::LaserScan scan = laser.scan(0, Time(), still(pose), rays);
  ASSERT_EQ(scan.ranges_m.size(), 1081U);
  EXPECT_NEAR(scan.angle_min_rad, -0.75 * M_PI, 1e-12);
  for (int i = 0; i < 1081; ++i) {
    const double angle = 0.3 + scan.angle_min_rad + i * scan.angle_increment_rad;
    EXPECT_NEAR(scan.ranges_m[static_cast<std::size_t>(i)], rangeInRoom({1, -1}, angle), 0.0006) << i;
  }
}

TEST(LaserScanner, SweepsWhileTheVehicleMovesAndTurns) {
  LaserScanner laser(quietLaser(), 1);
  const RayCaster rays(boxRoom());
  std::vector<Moment> track;
  const auto pose_at = [](double t) {
    return common::Pose3{common::quaternionFrom({0, 0, 3.0 * t}), {1 + 2.0 * t, -1 - t, 1}};
  };
  for (int ms = 0; ms <= 20; ++ms) track.push_back({Time::fromSeconds(0.001 * ms), pose_at(0.001 * ms), {}});
  const common::LaserScan scan = laser.scan(0, Time(), track, rays);
  double worst_if_still = 0.0;
  for (int i = 0; i < 1081; ++i) {
    const double t = (scan.time_increment * i).seconds();
    const double angle = scan.angle_min_rad + i * scan.angle_increment_rad;
    const common::Pose3 pose = pose_at(t);
    const double expected = rangeInRoom(pose.position_m.head<2>(), angle + 3.0 * t);
    EXPECT_NEAR(scan.ranges_m[static_cast<std::size_t>(i)], expected, 0.0007) << i;
    worst_if_still = std::max(worst_if_still, std::abs(expected - rangeInRoom({1, -1}, angle)));
  }
  EXPECT_GT(worst_if_still, 0.1) << "the motion matters";
}

TEST(LaserScanner, MirrorBeamsMeasureTheHeight) {
  common::LaserConfig config = quietLaser();
  config.mirror_first_beam = 1070;
  config.mirror_beams = 11;
  config.mirror_mount.z_m = 0.06;
  LaserScanner laser(config, 1);
  const RayCaster rays(boxRoom());
  const common::Pose3 pose{common::quaternionFrom({0.1, 0, 0}), {0, 0, 1.5}};
  const common::LaserScan scan = laser.scan(0, Time(), still(pose), rays);
  const double height = 1.5 + 0.06 * std::cos(0.1);
  for (int i = 1070; i < 1081; ++i) {
    const double fan = ((i - 1070) / 10.0 - 0.5) * config.mirror_spread_deg * M_PI / 180;
    EXPECT_NEAR(scan.ranges_m[static_cast<std::size_t>(i)], height / std::cos(0.1 + fan), 0.001);
  }
}

TEST(LaserScanner, HasTheConfiguredNoiseDropoutsAndLimits) {
  common::LaserConfig config;
  config.range_max_m = 4.5;
  config.dropout_rate = 0.05;
  LaserScanner laser(config, 3);
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("near", {0.05, -0.01, 0.5}, {0.06, 0.01, 1.5}));
  const RayCaster rays(world);
  int dropped = 0, counted = 0, beyond = 0, within = 0;
  double squares = 0.0;
  for (std::uint64_t frame = 0; frame < 50; ++frame) {
    const auto scan = laser.scan(frame, Time(), still({Eigen::Quaterniond::Identity(), {0, 0, 1}}), rays);
    for (int i = 0; i < 1081; ++i) {
      const double angle = scan.angle_min_rad + i * scan.angle_increment_rad;
      const double expected = rangeInRoom({0, 0}, angle);
      const float range = scan.ranges_m[static_cast<std::size_t>(i)];
      if (std::abs(angle) < 0.25) {
        if (std::abs(angle) < 0.15) {
          EXPECT_EQ(range, 0.0F) << "nearer than the device can tell";
        }
        continue;
      }
      ++counted;
      if (range == 0.0F) {
        ++dropped;
      } else if (expected > 4.6) {
        EXPECT_TRUE(std::isinf(range));
        ++beyond;
      } else if (expected < 4.4) {
        squares += (range - expected) * (range - expected);
        ++within;
      }
    }
  }
  EXPECT_NEAR(static_cast<double>(dropped) / counted, 0.05, 0.005);
  EXPECT_GT(beyond, 1000);
  EXPECT_NEAR(std::sqrt(squares / within), config.range_noise_m, 0.0005);
}

TEST(LaserScanner, NoiseDependsOnlyOnTheFrame) {
  LaserScanner a({}, 3), b({}, 3);
  const RayCaster rays(boxRoom());
  const auto track = still({Eigen::Quaterniond::Identity(), {0, 0, 1}});
  (void)a.scan(0, Time(), track, rays);
  EXPECT_EQ(a.scan(1, Time(), track, rays).ranges_m, b.scan(1, Time(), track, rays).ranges_m)
      << "whether frame 0 was measured changes nothing in frame 1";
  EXPECT_NE(a.scan(2, Time(), track, rays).ranges_m, b.scan(1, Time(), track, rays).ranges_m);
}

TEST(LaserScanner, SeesAPersonMoveDuringTheSweep) {
  LaserScanner laser(quietLaser(), 1);
  const RayCaster rays(boxRoom());
  const common::Pose3 pose{Eigen::Quaterniond::Identity(), {0, 0, 1}};
  std::vector<Moment> track;
  for (int ms = 0; ms <= 20; ++ms) {
    Actor person;
    person.position_world_m = {2.0 - 0.05 * ms, 0.0};  // Very fast: 50 m/s towards the laser.
    track.push_back({Time::fromSeconds(0.001 * ms), pose, {person}});
  }
  const auto scan = laser.scan(0, Time(), track, rays);
  const double at_s = (scan.time_increment * 540).seconds();  // The beam straight ahead.
  EXPECT_NEAR(scan.ranges_m[540], 2.0 - 50 * at_s - 0.25, 0.051);
}

TEST(Camera, ShowsColoursInTheRightPlace) {
  WorldModel world = boxRoom();
  for (Shape& shape : world.shapes) shape.color = Color(0.5F, 0.5F, 0.5F);
  world.shapes.push_back(boxShape("red", {3.0, 0.5, 0.5}, {3.5, 2.0, 1.5}));
  world.shapes.back().color = Color(1.0F, 0.0F, 0.0F);
  CameraConfig config;
  config.pixel_noise = 0.0;
  const RayCaster rays(world);
  const Camera camera(config, world, 1);
  const common::Image image = camera.render(0, {Eigen::Quaterniond::Identity(), {0, 0, 1}}, {}, rays);
  ASSERT_EQ(image.rgb.size(), 3U * 320 * 240);
  const auto pixel = [&](int u, int v) { return &image.rgb[static_cast<std::size_t>(3 * (v * 320 + u))]; };
  EXPECT_GT(pixel(80, 120)[0], 100) << "the red box is on the left";
  EXPECT_LT(pixel(80, 120)[1], 10);
  EXPECT_EQ(pixel(240, 120)[0], pixel(240, 120)[1]) << "the wall on the right is grey";
  EXPECT_NE(pixel(160, 5)[0], pixel(160, 120)[0]) << "the ceiling is shaded otherwise than the wall";
}

}  // namespace
}  // namespace swiftlet::simulation
