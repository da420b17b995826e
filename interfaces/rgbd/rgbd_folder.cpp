#include "interfaces/rgbd/rgbd_folder.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/core.h>

#include "common/blank_picture.hpp"
#include "common/error.hpp"
#include "common/hash.hpp"
#include "common/read_bytes.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;

/// Greater files are no images of a camera.
constexpr std::size_t kMostImageBytes = std::size_t{256} << 20;
/// A frame with a smaller part of measured pixels shows nothing that could be mapped.
constexpr double kLeastMeasured = 0.01;
/// Depth cameras measure between these. If nearly every depth is outside, the stored numbers mean something else.
constexpr double kPlausible_m = 0.1;
constexpr double kImplausible_m = 20.0;
constexpr double kMostImplausible = 0.95;

std::optional<FrameFault> faultOf(const common::DepthCodes& depth, double units_per_m) {
  std::size_t measured = 0, implausible = 0;
  for (const std::uint16_t code : depth.codes) {
    if (code == 0 || code == 65535) continue;
    ++measured;
    const double depth_m = code / units_per_m;
    if (depth_m < kPlausible_m || depth_m > kImplausible_m) ++implausible;
  }
  if (static_cast<double>(measured) < kLeastMeasured * static_cast<double>(depth.codes.size()))
    return FrameFault::kNoDepth;
  if (static_cast<double>(implausible) > kMostImplausible * static_cast<double>(measured))
    return FrameFault::kOtherScale;
  return std::nullopt;
}

/// The bytes of an image file; nullopt with the reason in `skipped`.
std::optional<std::string> bytesOf(const fs::path& file, SkippedFrame& skipped) {
  try {
    return common::readBytes(file, kMostImageBytes);
  } catch (const common::InputError& error) {
    skipped = {FrameFault::kMissing, error.what()};
    return std::nullopt;
  }
}

}  // namespace

const char* toString(FrameFault fault) {
  switch (fault) {
    case FrameFault::kMissing:
      return "an image is missing";
    case FrameFault::kUnreadable:
      return "an image is damaged, cut off or of another kind";
    case FrameFault::kOtherSize:
      return "an image has another shape than the calibration";
    case FrameFault::kNoDepth:
      return "hardly any depth was measured";
    case FrameFault::kOtherScale:
      return "the depths are implausible, their scale may be another one";
    case FrameFault::kBlack:
      return "the picture is black";
    case FrameFault::kWhite:
      return "the picture is white";
    case FrameFault::kRepeated:
      return "the pictures are those of the frame before";
    case FrameFault::kStampRepeated:
      return "the stamp is that of the frame before";
  }
  return "";
}

std::uint64_t RgbdFolder::skipped() const {
  return std::accumulate(skipped_.begin(), skipped_.end(), std::uint64_t{0});
}

std::optional<common::RgbdFrame> RgbdFolder::read(const RgbdListing::Pair& pair, SkippedFrame& skipped) {
  if (last_stamp_ && pair.stamp <= *last_stamp_) {
    skipped = {FrameFault::kStampRepeated, pair.color.string()};
    return std::nullopt;
  }
  const std::optional<std::string> color_bytes = bytesOf(pair.color, skipped);
  const std::optional<std::string> depth_bytes = color_bytes ? bytesOf(pair.depth, skipped) : std::nullopt;
  if (!depth_bytes) return std::nullopt;
  const std::uint64_t hash = common::fnv1a(*depth_bytes) + 31 * common::fnv1a(*color_bytes);
  const bool repeated = last_stamp_ && hash == last_hash_;
  last_hash_ = hash;
  if (repeated) {
    skipped = {FrameFault::kRepeated, pair.color.string()};
    return std::nullopt;
  }
  auto color = common::decodeColor(*color_bytes);
  if (!color) {
    skipped = {FrameFault::kUnreadable, fmt::format("{}: {}", pair.color.string(), color.error().reason.text())};
    return std::nullopt;
  }
  const auto depth = common::decodeDepth(*depth_bytes);
  if (!depth) {
    skipped = {FrameFault::kUnreadable, fmt::format("{}: {}", pair.depth.string(), depth.error().reason.text())};
    return std::nullopt;
  }
  const RgbdCalibration& known = listing_.calibration;
  const bool same_size = color->width_px == depth->width_px && color->height_px == depth->height_px;
  const bool shapes_fit =
      hasShapeOf(known.color, color->width_px, color->height_px) &&
      (known.is_registered ? same_size : hasShapeOf(known.depth, depth->width_px, depth->height_px));
  if (!shapes_fit) {
    skipped = {
        FrameFault::kOtherSize,
        fmt::format("{}: {}x{}, its depth {}x{}, the calibration {}x{}{}", pair.color.string(), color->width_px,
                    color->height_px, depth->width_px, depth->height_px, known.color.width_px, known.color.height_px,
                    known.is_registered
                        ? std::string()
                        : fmt::format(", its depth {}x{}", known.depth.width_px, known.depth.height_px))};
    return std::nullopt;
  }
  std::optional<FrameFault> fault = faultOf(*depth, known.depth_units_per_m);
  const common::Blank blank = common::blankOf(*color);
  if (blank != common::Blank::kNo) fault = blank == common::Blank::kBlack ? FrameFault::kBlack : FrameFault::kWhite;
  if (fault) {
    skipped = {*fault, pair.color.string()};
    return std::nullopt;
  }
  common::RgbdFrame frame = makeFrame(known, std::move(*color), *depth);
  frame.stamps = {pair.stamp, pair.stamp};
  return frame;
}

std::optional<common::RgbdFrame> RgbdFolder::next() {
  while (at_ < listing_.pairs.size()) {
    const RgbdListing::Pair& pair = listing_.pairs[at_++];
    SkippedFrame skipped{};
    if (std::optional<common::RgbdFrame> frame = read(pair, skipped)) {
      last_stamp_ = pair.stamp;
      return frame;
    }
    const auto fault = static_cast<std::size_t>(skipped.fault);
    if (skipped_[fault]++ == 0) first_[fault] = skipped.detail;
  }
  return std::nullopt;
}

}  // namespace swiftlet::interfaces
