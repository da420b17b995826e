// The RGB-D camera in a room whose surfaces are known.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "event_bytes.hpp"
#include "fixtures.hpp"

namespace swiftlet::simulation {
namespace {

using common::Time;

Scenario withCamera() {
  Scenario scenario;
  common::RgbdCameraConfig camera;
  camera.width_px = 64;
  camera.height_px = 48;
  scenario.rgbd_camera = camera;
  return scenario;
}

std::vector<common::SensorEvent> standing(const Scenario& scenario, double seconds) {
  SimulatedVehicle vehicle(boxRoom(), scenario);
  std::vector<common::SensorEvent> events;
  EXPECT_TRUE(vehicle.advanceTo(Time::fromSeconds(seconds), events));
  return events;
}

TEST(RgbdCamera, FramesComeAtTheirRateWithTheSizeOfTheDataSheet) {
  const Scenario scenario = withCamera();
  const auto frames = eventsOf<Rgbd>(standing(scenario, 2.0));
  ASSERT_NEAR(static_cast<double>(frames.size()), 30.0, 1.0);
  for (const Rgbd& frame : frames) {
    EXPECT_EQ(frame->camera.pixels(), 64 * 48);
    EXPECT_EQ(frame->color.rgb.size(), 3U * 64 * 48);
    EXPECT_EQ(frame->depth.depth_m.size(), 64U * 48);
    EXPECT_GT(frame->stamps.arrived, frame->stamps.measured);
  }
}

// Depths count along the view: a wall across it has the same depth in every pixel.
TEST(RgbdCamera, PointsOfTheFrameLieOnTheSurfaces) {
  Scenario scenario = withCamera();
  scenario.rgbd_camera->range_max_m = 10.0;
  scenario.rgbd_camera->inverse_depth_noise_1_m = scenario.rgbd_camera->inverse_depth_step_1_m = 0.0;
  scenario.rgbd_camera->depth_step_m = 0.0;
  SimulatedVehicle vehicle(boxRoom(), scenario);
  std::vector<common::SensorEvent> events;
  ASSERT_TRUE(vehicle.advanceTo(Time::fromSeconds(0.2), events));
  const Rgbd frame = eventsOf<Rgbd>(events).back();
  const common::Pose3 T_world_camera = vehicle.truth().T_world_body * scenario.rgbd_camera->mount.pose();
  int measured = 0;
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 64; ++u) {
      const float depth_m = frame->depth.at(u, v);
      if (!common::isMeasured(depth_m)) continue;
      ++measured;
      const Eigen::Vector3d point = T_world_camera * frame->camera.point_camera_m(u, v, static_cast<double>(depth_m));
      const double off_m = std::min({std::abs(point.x() - 5.0), std::abs(point.x() + 5.0), std::abs(point.y() - 4.0),
                                     std::abs(point.y() + 4.0), std::abs(point.z()), std::abs(point.z() - 3.0)});
      EXPECT_LT(off_m, 2e-3) << u << " " << v;
    }
  EXPECT_GT(measured, 1000);
}

TEST(RgbdCamera, AVehicleWithoutOneKeepsEveryByte) {
  const auto without = standing(Scenario(), 1.0);
  std::vector<common::SensorEvent> with;
  for (const auto& event : standing(withCamera(), 1.0))
    if (!std::holds_alternative<Rgbd>(event)) with.push_back(event);
  EXPECT_EQ(bytesOf(without, true), bytesOf(with, true));
}

TEST(RgbdCamera, TheSameSeedGivesTheSameBytes) {
  const auto first = standing(withCamera(), 1.0), second = standing(withCamera(), 1.0);
  EXPECT_EQ(bytesOf(first, true), bytesOf(second, true));
  Scenario other = withCamera();
  other.seed = 2;
  EXPECT_NE(bytesOf(first, true), bytesOf(standing(other, 1.0), true));
}

}  // namespace
}  // namespace swiftlet::simulation
