#include "mapping3d/odometry/frame_pyramid.hpp"

#include "common/check.hpp"

namespace swiftlet::mapping3d {
namespace {

/// Wider pictures are halved until they are not: what was measured (docs/decisions/mapping3d.md#032) is of 320 x 240
/// pixels.
constexpr int kGreatestWidth_px = 320;
/// The coarsest level has at least this height.
constexpr int kLeastHeight_px = 24;

PyramidLevel halvedLevel(const PyramidLevel& level) {
  return {vision::halved(level.camera), vision::halved(level.gray), vision::halved(level.depth)};
}

}  // namespace

FramePyramid makePyramid(const common::RgbdFrame& frame, int levels) {
  const auto pixels = static_cast<std::size_t>(frame.camera.pixels());
  SWIFTLET_CHECK(frame.color.rgb.size() == 3 * pixels && frame.depth.depth_m.size() == pixels);
  PyramidLevel finest{frame.camera, vision::grayOf(frame.color), frame.depth};
  while (finest.camera.width_px > kGreatestWidth_px) finest = halvedLevel(finest);
  FramePyramid pyramid{std::move(finest)};
  while (static_cast<int>(pyramid.size()) < levels && pyramid.back().camera.height_px >= 2 * kLeastHeight_px)
    pyramid.push_back(halvedLevel(pyramid.back()));
  return pyramid;
}

}  // namespace swiftlet::mapping3d
