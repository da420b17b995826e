// The stereo camera: two pictures of the same instant, exposed alike.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "common/blank_picture.hpp"
#include "event_bytes.hpp"
#include "rgbd_fixtures.hpp"

namespace swiftlet::simulation {
namespace {

using common::Time;

common::RgbdCameraConfig exactPair() {
  common::RgbdCameraConfig config = exactCamera();
  config.depth = common::DepthMethod::kStereo;
  config.baseline_m = 0.12;
  return config;
}

/// A white post before a black wall.
WorldModel postAt(double distance_m, const Color& light = Color::Ones()) {
  WorldModel world = wallAhead(6.0, Color::Zero());
  world.shapes.push_back(boxShape("post", {distance_m, -0.1, -5.0}, {distance_m + 0.01, 0.1, 5.0}));
  world.shapes.back().color = Color::Ones();
  world.shapes.back().pattern = Pattern::kBlank;
  world.light = light;
  return world;
}

/// Middle and width, in pixels, of what is bright in a row.
struct Bright {
  double middle_px = 0.0;
  int width_px = 0;
};
Bright brightIn(const common::Image& image, int v) {
  int first = image.width_px, last = -1;
  for (int u = 0; u < image.width_px; ++u) {
    if (image.rgb[static_cast<std::size_t>(3 * (v * image.width_px + u))] < 5) continue;
    first = std::min(first, u);
    last = u;
  }
  return {0.5 * (first + last), last - first + 1};
}

TEST(StereoCamera, APointIsSeenFartherLeftByTheRightCameraByFocalLengthAndBaseOverItsDepth) {
  const double focal_px = exactPair().camera().fx_px;
  for (const double depth_m : {1.0, 2.0, 4.0}) {
    const common::RgbdFrame pair = frameOf(postAt(depth_m), exactPair(), withoutNoise());
    ASSERT_TRUE(pair.right);
    EXPECT_TRUE(pair.depth.depth_m.empty());
    EXPECT_NEAR(brightIn(pair.color, 60).middle_px - brightIn(*pair.right, 60).middle_px, focal_px * 0.12 / depth_m,
                1.0);
  }
}

TEST(StereoCamera, TheRightCameraIsTurnedAsCalibrated) {
  common::RgbdCameraConfig turned = exactPair();
  turned.right_yaw_deg = 2.0;
  const auto middle_px = [](const common::RgbdCameraConfig& config) {
    return brightIn(*frameOf(postAt(2.0), config, withoutNoise()).right, 60).middle_px;
  };
  EXPECT_NEAR(middle_px(turned) - middle_px(exactPair()),
              exactPair().camera().fx_px * std::tan(2.0 * common::kRadPerDeg), 1.0);
}

TEST(StereoCamera, EachPictureHasNoiseOfItsOwn) {
  RgbdErrorsConfig errors = withoutNoise();
  errors.pixel_noise = 4.0;
  const common::RgbdFrame pair = frameOf(wallAhead(3.0), exactPair(), errors);
  // Differences of neighbours: light and shade of the wall are the same in both pictures.
  double product = 0.0, squares = 0.0;
  const std::vector<std::uint8_t>&left = pair.color.rgb, &right = pair.right->rgb;
  for (std::size_t i = 3; i < left.size(); i += 3) {
    product += (left[i] - left[i - 3]) * (right[i] - right[i - 3]);
    squares += std::pow(left[i] - left[i - 3], 2);
  }
  EXPECT_GT(squares, 0.0);
  EXPECT_LT(std::abs(product), 0.1 * squares);
}

/// The shutter times of a sensor that sees this light, frame by frame.
std::vector<double> shutters_s(ColorSensor& sensor, float light, int frames, int* mean = nullptr) {
  SeenImage seen{1, 1, {1.0F}, {0}, {Eigen::Array4f::Constant(light)}, {}};
  std::vector<double> times_s;
  for (int i = 0; i < frames; ++i) {
    const int value = sensor.take(static_cast<std::uint64_t>(i), seen).rgb[0];
    if (mean != nullptr) *mean = value;
    times_s.push_back(sensor.exposure_s());
  }
  return times_s;
}

RgbdErrorsConfig adapting() {
  RgbdErrorsConfig errors = withoutNoise();
  errors.exposure_s = 0.004;
  errors.longest_exposure_s = 0.03;
  errors.exposure_lag_s = 0.8;
  return errors;
}

TEST(StereoCamera, InTheDarkTheShutterIsOpenLongerBeforeTheLightIsAmplified) {
  ColorSensor sensor(adapting(), 0.25, 1);
  EXPECT_NEAR(shutters_s(sensor, 0.9F, 1).back(), 0.002, 1e-4);
  ColorSensor in_twilight(adapting(), 0.25, 1);
  EXPECT_NEAR(shutters_s(in_twilight, 0.09F, 1).back(), 0.02, 1e-3);
  ColorSensor in_the_dark(adapting(), 0.25, 1);
  EXPECT_DOUBLE_EQ(shutters_s(in_the_dark, 0.005F, 1).back(), 0.03);
}

TEST(StereoCamera, FromDarkToBrightThePicturesAreWhiteForSeconds) {
  ColorSensor sensor(adapting(), 0.25, 1);
  shutters_s(sensor, 0.02F, 20);
  int value = 0;
  int white = 0;
  do {
    shutters_s(sensor, 0.8F, 1, &value);
    ++white;
  } while (value > 249 && white < 100);
  EXPECT_GT(0.25 * white, 1.0);
  EXPECT_LT(0.25 * white, 5.0);
}

TEST(StereoCamera, WhatMovesIsBlurredMoreInTheDark) {
  const auto width_px = [](float light) {
    const WorldModel world = postAt(2.0, Color::Constant(light));
    RgbdCamera camera(exactPair(), adapting(), world, 1);
    const RayCaster rays(world);
    const auto track = turning({}, 1.0);
    static_cast<void>(camera.frame(0, kFrameTime, track, rays));  // The exposure follows from the frame before.
    const common::RgbdFrame pair = camera.frame(1, kFrameTime, track, rays);
    EXPECT_NEAR(brightIn(pair.color, 60).width_px, brightIn(*pair.right, 60).width_px, 2);
    return brightIn(pair.color, 60).width_px;
  };
  EXPECT_GT(width_px(0.05F), width_px(2.0F) + 2);
}

TEST(StereoCamera, UnderARoofItIsAsDarkAsTheWorldSays) {
  const auto brightness = [](bool roof, float indoor_light) {
    WorldModel world = wallAhead(3.0);
    world.indoor_light = indoor_light;
    if (roof) world.shapes.push_back(boxShape("roof", {-20.0, -20.0, 20.0}, {20.0, 20.0, 20.1}));
    RgbdErrorsConfig fixed = withoutNoise();
    return static_cast<double>(frameOf(world, exactPair(), fixed).color.rgb[3 * (60 * 160 + 80)]);
  };
  EXPECT_EQ(brightness(false, 0.25F), brightness(false, 1.0F));
  EXPECT_EQ(brightness(true, 1.0F), brightness(false, 1.0F));
  EXPECT_NEAR(brightness(true, 0.25F), 0.25 * brightness(false, 1.0F), 1.0);
}

TEST(StereoCamera, WithoutLightThereIsNoPicture) {
  WorldModel world = wallAhead(3.0);
  world.light = Color::Zero();
  RgbdErrorsConfig errors = adapting();
  errors.pixel_noise = 1.5;
  const common::RgbdFrame pair = frameOf(world, exactPair(), errors);
  EXPECT_EQ(common::blankOf(pair.color), common::Blank::kBlack);
  EXPECT_EQ(common::blankOf(*pair.right), common::Blank::kBlack);
}

Scenario withPair() {
  Scenario scenario;
  common::RgbdCameraConfig camera = exactPair();
  camera.width_px = 64;
  camera.height_px = 48;
  camera.rate_hz = 4.0;
  scenario.rgbd_camera = camera;
  scenario.sensors.rgbd_errors = adapting();
  scenario.sensors.rgbd_link.latency_s = 0.3;
  return scenario;
}

std::vector<common::SensorEvent> standingWithPair(const Scenario& scenario, double seconds) {
  SimulatedVehicle vehicle(boxRoom(), scenario);
  std::vector<common::SensorEvent> events;
  EXPECT_TRUE(vehicle.advanceTo(Time::fromSeconds(seconds), events));
  return events;
}

TEST(StereoCamera, PairsComeLateAtTheirRateAndTheSameSeedGivesTheSameBytes) {
  const auto first = standingWithPair(withPair(), 2.0), second = standingWithPair(withPair(), 2.0);
  const auto pairs = eventsOf<Rgbd>(first), again = eventsOf<Rgbd>(second);
  ASSERT_NEAR(static_cast<double>(pairs.size()), 7.0, 1.0);
  ASSERT_EQ(pairs.size(), again.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_NEAR((pairs[i]->stamps.arrived - pairs[i]->stamps.measured).seconds(), 0.315, 0.01);
    EXPECT_EQ(pairs[i]->color.rgb, again[i]->color.rgb);
    EXPECT_EQ(pairs[i]->right->rgb, again[i]->right->rgb);
  }
}

}  // namespace
}  // namespace swiftlet::simulation
