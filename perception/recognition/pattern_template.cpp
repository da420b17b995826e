#include "perception/recognition/pattern_template.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "common/image_decoder.hpp"
#include "vision/corners.hpp"

namespace swiftlet::perception {
namespace {

using common::Message;

constexpr int kLeastSide_px = 16;
constexpr int kGreatestAspect = 8;
/// Four points give a homography.
constexpr std::size_t kLeastCorners = 4;
/// A template with more pixels is halved: a picture of the camera never shows as many.
constexpr int kGreatestSide_px = 1024;

}  // namespace

PatternTemplate::PatternTemplate(std::string name, vision::GrayImage picture, double width_m)
    : name_(std::move(name)), picture_(std::move(picture)), width_m_(width_m) {}

tl::expected<PatternTemplate, Message> PatternTemplate::create(std::string name, vision::GrayImage picture,
                                                               double width_m) {
  if (!(std::isfinite(width_m) && width_m > 0.0))
    return tl::unexpected(Message("pattern.no-size", "is printed {} m wide; a pattern has a size above 0", width_m));
  const int shorter = std::min(picture.width_px, picture.height_px);
  const int longer = std::max(picture.width_px, picture.height_px);
  if (shorter < kLeastSide_px || longer > kGreatestAspect * shorter ||
      picture.values.size() !=
          static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(std::max(picture.height_px, 0)))
    return tl::unexpected(Message("pattern.shape",
                                  "is a picture of {} x {} pixels; a pattern has sides of 16 pixels or more, of which "
                                  "one is at most 8 times the other",
                                  picture.width_px, picture.height_px));
  while (std::max(picture.width_px, picture.height_px) > kGreatestSide_px) picture = vision::halved(picture);
  if (vision::findCorners(picture, {}).size() < kLeastCorners)
    return tl::unexpected(Message("pattern.no-corners",
                                  "has no corners, by which a pattern is found; choose a picture with shapes in it"));
  return PatternTemplate(std::move(name), std::move(picture), width_m);
}

tl::expected<PatternTemplate, Message> PatternTemplate::read(std::string name, std::string_view bytes, double width_m) {
  const auto image = common::decodeGrey(bytes);
  if (!image) return tl::unexpected(image.error().reason);
  vision::GrayImage picture{image->width_px, image->height_px, image->brightness};
  for (std::size_t i = 0; i < image->opacity.size(); ++i) {
    const int opacity = image->opacity[i];
    picture.values[i] = static_cast<std::uint8_t>((picture.values[i] * opacity + 255 * (255 - opacity) + 127) / 255);
  }
  return create(std::move(name), std::move(picture), width_m);
}

}  // namespace swiftlet::perception
