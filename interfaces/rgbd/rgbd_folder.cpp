#include "interfaces/rgbd/rgbd_folder.hpp"

#include <numeric>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "common/blank_picture.hpp"
#include "common/error.hpp"
#include "common/hash.hpp"
#include "common/read_bytes.hpp"
#include "interfaces/rgbd/image_messages.hpp"
#include "interfaces/rgbd/rgbd_bag.hpp"

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

/// The two images of a pair as they are stored.
struct StoredImages {
  common::Image color;
  common::DepthCodes depth;
  std::uint64_t hash = 0;  ///< Of what is stored.
};
using StoredOrSkipped = tl::expected<StoredImages, SkippedFrame>;

StoredOrSkipped imagesOf(const RgbdListing::Pair& pair, tl::expected<common::Image, common::ImageFault> color,
                         tl::expected<common::DepthCodes, common::ImageFault> depth) {
  const auto unreadable = [](const fs::path& image, const common::ImageFault& fault) {
    return tl::unexpected(
        SkippedFrame{FrameFault::kUnreadable, fmt::format("{}: {}", image.string(), fault.reason.text())});
  };
  if (!color) return unreadable(pair.color, color.error());
  if (!depth) return unreadable(pair.depth, depth.error());
  return StoredImages{*std::move(color), *std::move(depth), 0};
}

StoredOrSkipped fromFiles(const RgbdListing::Pair& pair) {
  try {
    const std::string color = common::readBytes(pair.color, kMostImageBytes);
    const std::string depth = common::readBytes(pair.depth, kMostImageBytes);
    auto images = imagesOf(pair, common::decodeColor(color), common::decodeDepth(depth));
    if (images) images->hash = common::fnv1a(depth) + 31 * common::fnv1a(color);
    return images;
  } catch (const common::InputError& error) {
    return tl::unexpected(SkippedFrame{FrameFault::kMissing, error.what()});
  }
}

template <typename Number>
std::string_view bytesOf(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

/// Its messages have times and numbers of their own, so the pixels tell whether an image is repeated.
StoredOrSkipped fromBag(RgbdBagImages& bag, const RgbdListing::Pair& pair) {
  const auto [color, depth] = bag.of(pair);
  if (color == nullptr || depth == nullptr)
    return tl::unexpected(SkippedFrame{FrameFault::kMissing, (color == nullptr ? pair.color : pair.depth).string() +
                                                                 ": is not in the bag, or too far "
                                                                 "from its partner there"});
  auto images = imagesOf(pair, colorOf(*color), depthOf(*depth));
  if (images)
    images->hash = common::fnv1a(bytesOf(images->depth.codes)) + 31 * common::fnv1a(bytesOf(images->color.rgb));
  return images;
}

/// Why images of these sizes do not belong to the calibration; empty if they do.
std::string sizeFault(const RgbdCalibration& known, const common::Image& color, const common::DepthCodes& depth) {
  const bool same_size = color.width_px == depth.width_px && color.height_px == depth.height_px;
  if (hasShapeOf(known.color, color.width_px, color.height_px) &&
      (known.is_registered ? same_size : hasShapeOf(known.depth, depth.width_px, depth.height_px)))
    return "";
  return fmt::format("{}x{}, its depth {}x{}, the calibration {}x{}{}", color.width_px, color.height_px, depth.width_px,
                     depth.height_px, known.color.width_px, known.color.height_px,
                     known.is_registered
                         ? std::string()
                         : fmt::format(", its depth {}x{}", known.depth.width_px, known.depth.height_px));
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

RgbdFolder::RgbdFolder(RgbdListing listing) : listing_(std::move(listing)) {
  if (listing_.bag) bag_ = std::make_unique<RgbdBagImages>(*listing_.bag);
}

RgbdFolder::~RgbdFolder() = default;
RgbdFolder::RgbdFolder(RgbdFolder&&) noexcept = default;

std::optional<common::RgbdFrame> RgbdFolder::read(const RgbdListing::Pair& pair, SkippedFrame& skipped) {
  const auto skip = [&](FrameFault fault, std::string detail) {
    skipped = {fault, std::move(detail)};
    return std::nullopt;
  };
  if (last_stamp_ && pair.stamp <= *last_stamp_) return skip(FrameFault::kStampRepeated, pair.color.string());
  StoredOrSkipped images = bag_ ? fromBag(*bag_, pair) : fromFiles(pair);
  if (!images) return skip(images.error().fault, std::move(images.error().detail));
  const bool repeated = last_stamp_ && images->hash == last_hash_;
  last_hash_ = images->hash;
  if (repeated) return skip(FrameFault::kRepeated, pair.color.string());
  const std::string size_fault = sizeFault(listing_.calibration, images->color, images->depth);
  if (!size_fault.empty()) return skip(FrameFault::kOtherSize, fmt::format("{}: {}", pair.color.string(), size_fault));
  std::optional<FrameFault> fault = faultOf(images->depth, listing_.calibration.depth_units_per_m);
  const common::Blank blank = common::blankOf(images->color);
  if (blank != common::Blank::kNo) fault = blank == common::Blank::kBlack ? FrameFault::kBlack : FrameFault::kWhite;
  if (fault) return skip(*fault, pair.color.string());
  common::RgbdFrame frame = makeFrame(listing_.calibration, std::move(images->color), images->depth);
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
