// What motion and time do to the frames of the RGB-D camera.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rgbd_fixtures.hpp"

namespace swiftlet::simulation {
namespace {

/// A white post before a black wall.
WorldModel whitePost() {
  WorldModel world = wallAhead(3.0, Color::Zero());
  world.shapes.push_back(boxShape("post", {2.0, -0.1, -5.0}, {2.01, 0.1, 5.0}));
  world.shapes.back().color = Color::Ones();
  world.shapes.back().pattern = Pattern::kBlank;
  return world;
}

/// First and last column of a row in which the post is seen, however faintly.
std::pair<int, int> columnsOfPost(const common::RgbdFrame& frame, int v) {
  int first = 160, last = -1;
  for (int u = 0; u < 160; ++u) {
    if (frame.color.rgb[static_cast<std::size_t>(3 * (v * 160 + u))] < 5) continue;
    first = std::min(first, u);
    last = u;
  }
  return {first, last};
}

TEST(RgbdTime, AnOpenShutterBlursWhatMovesByTheWayItMoves) {
  RgbdErrorsConfig errors = withoutNoise();
  errors.exposure_s = 0.04;
  const double rate_rad_s = 2.0, focal_px = exactCamera().camera().fx_px;
  const auto sharp = columnsOfPost(frameOf(whitePost(), exactCamera(), errors), 60);
  const auto blurred = columnsOfPost(frameOf(whitePost(), exactCamera(), errors, {}, rate_rad_s), 60);
  const double motion_px = rate_rad_s * errors.exposure_s * focal_px;
  EXPECT_GT(motion_px, 10.0);
  EXPECT_NEAR((blurred.second - blurred.first) - (sharp.second - sharp.first), motion_px, 2.0);
  EXPECT_NEAR(blurred.first + blurred.second, sharp.first + sharp.second, 2) << "to both sides alike";
}

TEST(RgbdTime, ABlurredImageKeepsItsLight) {
  RgbdErrorsConfig errors = withoutNoise();
  errors.exposure_s = 0.02;
  const auto sumOf = [&](double rate_rad_s) {
    const common::RgbdFrame frame = frameOf(whitePost(), exactCamera(), errors, {}, rate_rad_s);
    double sum = 0.0;
    for (const std::uint8_t byte : frame.color.rgb) sum += byte;
    return sum;
  };
  EXPECT_NEAR(sumOf(1.0) / sumOf(0.0), 1.0, 0.03);
}

// The shutter of the lowest row opens last, when the camera has turned to the left and the post is farther to the
// right.
TEST(RgbdTime, ARollingShutterLeansWhatMoves) {
  common::RgbdCameraConfig config = exactCamera();
  config.row_time_s = 0.0002;
  const common::RgbdFrame frame = frameOf(whitePost(), config, withoutNoise(), {}, 1.0);
  const double lean_px = columnsOfPost(frame, 119).first - columnsOfPost(frame, 0).first;
  EXPECT_NEAR(lean_px, 1.0 * 119 * config.row_time_s * frame.camera.fx_px, 1.0);
  EXPECT_NEAR(frame.row_time.seconds(), config.row_time_s, 1e-9);
  EXPECT_EQ(columnsOfPost(frame, 0), columnsOfPost(frameOf(whitePost(), exactCamera(), withoutNoise()), 0));
}

TEST(RgbdTime, TheExposureFollowsTheBrightnessWithALag) {
  RgbdErrorsConfig errors = withoutNoise();
  errors.exposure_lag_s = 0.3;
  const WorldModel bright = wallAhead(2.0, Color::Constant(0.8F)), dark = wallAhead(2.0, Color::Constant(0.15F));
  RgbdCamera camera(exactCamera(), errors, bright, 1), in_dark(exactCamera(), errors, dark, 1);
  const RayCaster bright_rays(bright), dark_rays(dark);
  const auto middle = [](const common::RgbdFrame& frame) { return frame.color.rgb[3 * (60 * 160 + 80)]; };
  const int first = middle(camera.frame(0, kFrameTime, turning({}), bright_rays));
  EXPECT_NEAR(first, 115, 10) << "the camera starts adjusted";
  EXPECT_NEAR(middle(in_dark.frame(0, kFrameTime, turning({}), dark_rays)), first, 10);
  // The wall turns dark: at first the image is darker, and some frames later it is as bright as before.
  ColorSensor sensor(errors, 1.0 / 15.0, 1);
  SeenImage seen{1, 1, {1.0F}, {0}, {Eigen::Array4f::Constant(0.8F)}, {}};
  const int adjusted = sensor.take(0, seen).rgb[0];
  seen.light[0].setConstant(0.15F);
  EXPECT_LT(sensor.take(1, seen).rgb[0], adjusted / 2);
  for (std::uint64_t frame = 2; frame < 40; ++frame) static_cast<void>(sensor.take(frame, seen));
  EXPECT_NEAR(sensor.take(40, seen).rgb[0], adjusted, 5);
}

TEST(RgbdTime, StampsAreOfTheCamerasOwnClock) {
  RgbdErrorsConfig errors = withoutNoise();
  errors.clock_offset_s = 0.005;
  errors.clock_drift_ppm = 100.0;
  EXPECT_NEAR(frameOf(wallAhead(2.0), exactCamera(), errors).stamps.measured.seconds(), 1.0051, 1e-9);
}

TEST(RgbdTime, TheTrueMountIsOffTheDataSheet) {
  common::RgbdCameraConfig config = exactCamera();
  config.mount.x_m = 0.2;
  RgbdErrorsConfig errors = withoutNoise();
  errors.mount_error.x_m = 0.01;
  errors.mount_error.yaw_deg = 1.0;
  const common::RgbdFrame exact = frameOf(whitePost(), config, withoutNoise());
  const common::RgbdFrame off = frameOf(whitePost(), config, errors);
  EXPECT_NEAR(exact.depth.at(80, 60), 1.8, 1e-3);
  EXPECT_NEAR(off.depth.at(80, 60), 1.79, 2e-3);
  const double turned_px = exactCamera().camera().fx_px * common::kRadPerDeg;
  EXPECT_NEAR(columnsOfPost(off, 60).first - columnsOfPost(exact, 60).first, turned_px, 1.0);
}

// Each frame of a flight shows the world as it was at its stamp, though it is made later.
TEST(RgbdTime, AFrameIsOfTheTimeOfItsStamp) {
  Scenario scenario;
  scenario.rgbd_camera = exactCamera();
  scenario.sensors.rgbd_errors = withoutNoise();
  scenario.sensors.rgbd_errors.exposure_s = 0.02;
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(0.0, 0.0, 1.0);
  ASSERT_TRUE(pilot.fly(3.0));
  pilot.yaw_rate_rad_s = 1.5;
  std::vector<Moment> truth;
  for (int tick = 0; tick < 100; ++tick) {
    pilot.steer();
    ASSERT_TRUE(pilot.advance());
    truth.push_back({vehicle.now(), vehicle.truth().T_world_body, {}});
  }
  int compared = 0;
  for (const Rgbd& frame : eventsOf<Rgbd>(pilot.events)) {
    const common::Time time = frame->stamps.measured;
    if (time < truth.front().time + common::Duration::fromMilliseconds(50) || time > truth.back().time) continue;
    RgbdCamera camera(exactCamera(), withoutNoise(), vehicle.world(), 1);
    const common::RgbdFrame expected = camera.frame(0, time, truth, vehicle.rays());
    ++compared;
    std::vector<float> off_m;
    for (std::size_t i = 0; i < expected.depth.depth_m.size(); i += 7)
      off_m.push_back(std::abs(expected.depth.depth_m[i] - frame->depth.depth_m[i]));
    std::nth_element(off_m.begin(), off_m.begin() + static_cast<std::ptrdiff_t>(off_m.size() / 2), off_m.end());
    EXPECT_LT(off_m[off_m.size() / 2], 2e-3);
  }
  EXPECT_GT(compared, 8);
}

}  // namespace
}  // namespace swiftlet::simulation
