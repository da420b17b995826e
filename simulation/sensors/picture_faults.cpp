#include "simulation/sensors/picture_faults.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

#include "common/check.hpp"
#include "common/rgbd_frame.hpp"

namespace swiftlet::simulation {
namespace {

/// Left becomes right. A pixel has `channels` values.
template <typename Value>
void flip(std::vector<Value>& values, int width_px, int channels) {
  const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(width_px) * channels;
  for (auto begin = values.begin(); begin != values.end(); begin += row) {
    std::reverse(begin, begin + row);
    for (auto pixel = begin; pixel != begin + row; pixel += channels) std::reverse(pixel, pixel + channels);
  }
}

/// Every second pixel of every second row.
template <typename Value>
std::vector<Value> halved(const std::vector<Value>& values, int width_px, int height_px, int channels) {
  std::vector<Value> smaller;
  for (int v = 0; v + 1 < height_px; v += 2)
    for (int u = 0; u + 1 < width_px; u += 2) {
      const auto pixel = values.begin() + (static_cast<std::ptrdiff_t>(v) * width_px + u) * channels;
      smaller.insert(smaller.end(), pixel, pixel + channels);
    }
  return smaller;
}

void spoil(FaultKind kind, common::Image& image) {
  if (kind == FaultKind::kBlack) std::fill(image.rgb.begin(), image.rgb.end(), std::uint8_t{0});
  if (kind == FaultKind::kWhite) std::fill(image.rgb.begin(), image.rgb.end(), std::uint8_t{255});
  if (kind == FaultKind::kFlipped) flip(image.rgb, image.width_px, 3);
  if (kind == FaultKind::kOtherSize)
    image = {image.width_px / 2, image.height_px / 2, halved(image.rgb, image.width_px, image.height_px, 3)};
}

/// The pattern is its own light, so it is seen in the dark; sunlight outshines it.
void spoil(FaultKind kind, common::DepthImage& depth) {
  if (kind == FaultKind::kWhite) std::fill(depth.depth_m.begin(), depth.depth_m.end(), common::DepthImage::kUnknown);
  if (kind == FaultKind::kFlipped) flip(depth.depth_m, depth.width_px, 1);
  if (kind == FaultKind::kOtherSize)
    depth = {depth.width_px / 2, depth.height_px / 2, halved(depth.depth_m, depth.width_px, depth.height_px, 1)};
}

}  // namespace

std::optional<common::SensorEvent> withPictureFault(FaultKind kind, const common::SensorEvent& event) {
  if (!isOfPictures(kind)) return std::nullopt;
  if (const auto* frame = std::get_if<std::shared_ptr<const common::CameraFrame>>(&event)) {
    auto copy = std::make_shared<common::CameraFrame>(**frame);
    spoil(kind, copy->image);
    return std::shared_ptr<const common::CameraFrame>(std::move(copy));
  }
  const auto* frame = std::get_if<std::shared_ptr<const common::RgbdFrame>>(&event);
  SWIFTLET_CHECK(frame != nullptr, event.index());
  auto copy = std::make_shared<common::RgbdFrame>(**frame);
  spoil(kind, copy->color);
  spoil(kind, copy->depth);
  if (copy->right) {
    auto right = std::make_shared<common::Image>(*copy->right);
    spoil(kind, *right);
    if (kind == FaultKind::kExchanged) std::swap(copy->color, *right);
    copy->right = kind == FaultKind::kOneSided ? nullptr : std::move(right);
  }
  return std::shared_ptr<const common::RgbdFrame>(std::move(copy));
}

}  // namespace swiftlet::simulation
