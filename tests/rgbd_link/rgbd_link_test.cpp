// Frames over a radio: depths without loss, as many as it carries, the newest first.
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "mapping3d/link/depth_codec.hpp"
#include "mapping3d/link/frame_packet.hpp"
#include "mapping3d/link/radio_link.hpp"
#include "mapping3d/voxels/voxel_mapper.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::DepthImage;
using common::Duration;
using common::RgbdFrame;
using common::Time;

/// A slanted wall with holes, in whole millimetres, and a picture with some structure.
RgbdFrame frameAt(double time_s, unsigned seed = 1) {
  std::mt19937 random(seed);
  RgbdFrame frame;
  frame.stamps = {Time::fromSeconds(time_s), Time::fromSeconds(time_s + 0.01)};
  frame.camera = {160, 120, 131.25, 131.25, 79.5, 59.5};
  frame.depth = {160, 120, {}};
  frame.color = {160, 120, {}};
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u) {
      const auto millimetres = 1500U + static_cast<unsigned>(5 * u + 2 * v) + random() % 4U;
      const bool hole = random() % 50U == 0U;
      frame.depth.depth_m.push_back(hole ? DepthImage::kUnknown : static_cast<float>(millimetres / 1000.0));
      for (int c = 0; c < 3; ++c) frame.color.rgb.push_back(static_cast<std::uint8_t>(u + v / 2 + 20 * c));
    }
  return frame;
}

/// Bit by bit, since NaN equals nothing.
bool sameBits(const DepthImage& a, const DepthImage& b) {
  if (a.depth_m.size() != b.depth_m.size()) return false;
  for (std::size_t i = 0; i < a.depth_m.size(); ++i)
    if (std::bit_cast<std::uint32_t>(a.depth_m[i]) != std::bit_cast<std::uint32_t>(b.depth_m[i])) return false;
  return true;
}

TEST(DepthCodec, KeepsEveryBitOfWholeMillimetres) {
  DepthImage depth = frameAt(0).depth;
  depth.depth_m[7] = DepthImage::kTooFar;
  const auto bytes = encodeDepth(depth);
  EXPECT_LT(bytes.size(), depth.depth_m.size()) << "less than a byte a pixel";
  const auto again = decodeDepth(bytes, 160, 120);
  ASSERT_TRUE(again) << again.error();
  EXPECT_TRUE(sameBits(depth, *again));
}

TEST(DepthCodec, KeepsEveryBitOfMillimetresInSinglePrecision) {
  DepthImage depth{160, 120, {}};
  for (int i = 0; i < 160 * 120; ++i) depth.depth_m.push_back(0.001F * static_cast<float>(700 + i % 4300));
  const auto bytes = encodeDepth(depth);
  EXPECT_LT(bytes.size(), depth.depth_m.size());
  const auto again = decodeDepth(bytes, 160, 120);
  ASSERT_TRUE(again) << again.error();
  EXPECT_TRUE(sameBits(depth, *again));
}

TEST(DepthCodec, KeepsEveryBitOfAnyNumbers) {
  std::mt19937 random(3);
  DepthImage depth{160, 120, {}};
  for (int i = 0; i < 160 * 120; ++i)
    depth.depth_m.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(random())));
  depth.depth_m[0] = std::numeric_limits<float>::quiet_NaN();
  depth.depth_m[1] = -0.0F;
  const auto again = decodeDepth(encodeDepth(depth), 160, 120);
  ASSERT_TRUE(again) << again.error();
  EXPECT_TRUE(sameBits(depth, *again));
}

TEST(DepthCodec, RefusesOtherBytes) {
  const auto bytes = encodeDepth(frameAt(0).depth);
  EXPECT_FALSE(decodeDepth({}, 160, 120));
  EXPECT_FALSE(decodeDepth(bytes, 0, 120));
  EXPECT_FALSE(decodeDepth(bytes, 160, 60)) << "more pixels than asked for";
  EXPECT_FALSE(decodeDepth(bytes, 320, 240)) << "fewer";
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    auto damaged = bytes;
    damaged.resize(1 + random() % damaged.size());
    damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
    (void)decodeDepth(damaged, 160, 120);  // Any answer, but no crash.
  }
}

/// Offers frames at 15 Hz for ten seconds and takes what comes through, tick by tick.
std::vector<std::shared_ptr<const RgbdFrame>> through(RadioLink& link) {
  std::vector<std::shared_ptr<const RgbdFrame>> arrived;
  int offered = 0;
  for (int tick = 0; tick <= 1100; ++tick) {
    const Time now = Time::fromSeconds(0.01 * tick);
    while (offered < 150 && offered / 15.0 + 0.01 <= now.seconds()) {
      link.offer(std::make_shared<const RgbdFrame>(frameAt(offered / 15.0, static_cast<unsigned>(offered))));
      ++offered;
    }
    while (auto frame = link.take(now)) {
      EXPECT_LE(frame->stamps.arrived, now);
      arrived.push_back(std::move(frame));
    }
  }
  return arrived;
}

TEST(RadioLink, CarriesNoMoreThanItsRateAndDropsTheOldestFirst) {
  RadioLinkConfig config;
  config.link_kB_s = 60.0;
  RadioLink link(config);
  const auto arrived = through(link);
  const RadioCounts& counts = link.counts();
  EXPECT_EQ(counts.offered, 150u);
  EXPECT_EQ(counts.sent, arrived.size());
  EXPECT_LE(static_cast<double>(counts.bytes), 60e3 * 10.5);
  EXPECT_GT(static_cast<double>(counts.bytes), 60e3 * 9.0) << "it is used";
  EXPECT_GT(counts.replaced, 20u);
  EXPECT_EQ(counts.offered, counts.sent + counts.replaced + counts.late);
  for (std::size_t i = 1; i < arrived.size(); ++i)
    EXPECT_GT(arrived[i]->stamps.measured, arrived[i - 1]->stamps.measured);
}

TEST(RadioLink, WithEnoughRateEveryFrameComes) {
  RadioLinkConfig config;
  config.link_kB_s = 5000.0;
  RadioLink link(config);
  EXPECT_EQ(through(link).size(), 150u);
  EXPECT_LT(4 * link.counts().bytes, link.counts().raw_bytes);
}

TEST(RadioLink, FramesThatTakeTooLongAreDropped) {
  RadioLinkConfig config;
  config.link_kB_s = 20.0;
  config.oldest_s = 0.05;
  RadioLink link(config);
  EXPECT_TRUE(through(link).empty());
  EXPECT_GT(link.counts().late, 0u);
}

/// What would come too late is sent with a quarter of the pixels, and whole again when the radio carries it.
TEST(RadioLink, FramesThatAreTooLargeForItAreHalved) {
  RadioLinkConfig config;
  config.link_kB_s = 100.0;
  RadioLink link(config);
  std::mt19937 random(7);
  RgbdFrame noisy = frameAt(0.0);
  noisy.camera = {320, 240, 262.5, 262.5, 159.5, 119.5};
  noisy.color = {320, 240, std::vector<std::uint8_t>(3 * 320 * 240, 128)};
  noisy.depth = {320, 240, {}};
  for (int i = 0; i < 320 * 240; ++i)
    noisy.depth.depth_m.push_back(static_cast<float>((1500U + random() % 64U) / 1000.0));
  RgbdFrame flat = noisy;
  for (float& depth_m : flat.depth.depth_m) depth_m = 2.0F;
  std::vector<int> widths;
  const auto offer = [&](RgbdFrame frame, double time_s) {
    frame.stamps = {Time::fromSeconds(time_s), Time::fromSeconds(time_s + 0.01)};
    link.offer(std::make_shared<const RgbdFrame>(std::move(frame)));
    while (const auto arrived = link.take(Time::fromSeconds(time_s + 0.5))) {
      widths.push_back(arrived->color.width_px);
      EXPECT_EQ(arrived->camera, arrived->color.width_px == 160
                                     ? (common::PinholeCamera{160, 120, 131.25, 131.25, 79.5, 59.5})
                                     : noisy.camera);
    }
  };
  offer(noisy, 0.0);
  offer(noisy, 1.0);
  EXPECT_EQ(link.halvings(), 1);
  for (int i = 2; i < 5; ++i) offer(flat, i);
  EXPECT_EQ(link.halvings(), 0);
  EXPECT_EQ(widths, (std::vector<int>{160, 160, 160, 320, 320}));
  EXPECT_EQ(link.counts().halved, 3u);
  EXPECT_EQ(link.counts().late, 0u);
}

TEST(FramePacket, AHalvedFrameShowsTheSameSurfaces) {
  const RgbdFrame whole = frameAt(0.0);
  const RgbdFrame half = halved(whole);
  EXPECT_EQ(half.camera.pixels(), 80 * 60);
  for (const auto& [u, v] : {std::pair{10, 10}, {40, 30}, {70, 50}}) {
    const Eigen::Vector3d point_m = half.camera.point_camera_m(u, v, static_cast<double>(half.depth.at(u, v)));
    const Eigen::Vector2d pixel = whole.camera.pixel(point_m);
    EXPECT_NEAR(pixel.x(), 2 * u + 0.5, 1e-9) << "the middle of its four pixels";
    EXPECT_NEAR(pixel.y(), 2 * v + 0.5, 1e-9);
    EXPECT_NEAR(static_cast<double>(half.depth.at(u, v)), static_cast<double>(whole.depth.at(2 * u, 2 * v)), 0.02);
    EXPECT_NEAR(half.color.rgb[static_cast<std::size_t>(3 * (v * 80 + u))],
                whole.color.rgb[static_cast<std::size_t>(3 * (2 * v * 160 + 2 * u))], 2);
  }
}

/// Packets have nothing to do with each other: of those that arrive, in any order, the voxels are the same as without a
/// radio.
TEST(RadioLink, LossAndDisorderChangeNothingButTheDensity) {
  std::vector<RgbdFrame> frames;
  std::vector<FramePacket> packets;
  for (unsigned i = 0; i < 8; ++i) {
    frames.push_back(frameAt(i / 15.0, i));
    packets.push_back(packed(frames.back(), 80));
  }
  VoxelMapper direct(VoxelConfig{}), received(VoxelConfig{});
  for (const std::size_t i : {6U, 1U, 4U, 3U}) {
    const common::Pose3 T_map_camera{Eigen::Quaterniond::Identity(), {0.1 * static_cast<double>(i), 0.0, 1.0}};
    const auto frame = unpacked(packets[i]);
    ASSERT_TRUE(frame) << frame.error();
    EXPECT_EQ(frame->stamps.measured, frames[i].stamps.measured);
    direct.insert(frames[i].depth, frames[i].camera, T_map_camera);
    received.insert(frame->depth, frame->camera, T_map_camera);
    double difference = 0.0;
    for (std::size_t k = 0; k < frame->color.rgb.size(); ++k)
      difference += std::abs(static_cast<double>(frame->color.rgb[k]) - frames[i].color.rgb[k]);
    EXPECT_LT(difference / static_cast<double>(frame->color.rgb.size()), 3.0);
  }
  ASSERT_EQ(received.map().blocks(), direct.map().blocks());
  for (const common::VoxelIndex block : direct.map().blocks())
    EXPECT_EQ(received.map().block(block)->evidence, direct.map().block(block)->evidence);
}

}  // namespace
}  // namespace swiftlet::mapping3d
