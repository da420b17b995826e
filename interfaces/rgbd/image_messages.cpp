#include "interfaces/rgbd/image_messages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "common/config_check.hpp"
#include "interfaces/laser_log/log_fields.hpp"

namespace swiftlet::interfaces {
namespace {

using common::DepthCodes;
using common::Image;
using common::ImageFault;
using common::Message;
using tl::unexpected;

/// Hashes of the definitions of the types.
constexpr std::string_view kImageMd5 = "060021388200f6f0f447d0fcd9c64743";
constexpr std::string_view kCompressedMd5 = "8f7a12909da2c9d3332d540a0977563f";
constexpr std::string_view kCameraInfoMd5 = "c9a58c1b0b154e0e6da7578cb991d214";

bool isOf(const BagConnection& connection, std::string_view type, std::string_view md5) {
  return connection.type == type && (connection.md5sum == md5 || connection.md5sum == "*" || connection.md5sum.empty());
}

/// The bytes a pixel, and where in them red, green and blue are.
struct PixelLayout {
  std::string_view encoding;
  std::size_t bytes, red, green, blue;
};
constexpr std::array<PixelLayout, 6> kLayouts{{{"rgb8", 3, 0, 1, 2},
                                               {"bgr8", 3, 2, 1, 0},
                                               {"rgba8", 4, 0, 1, 2},
                                               {"bgra8", 4, 2, 1, 0},
                                               {"8UC3", 3, 2, 1, 0},
                                               {"mono8", 1, 0, 0, 0}}};

bool startsLikeDepth(std::string_view encoding) {
  return encoding == "16UC1" || encoding == "mono16" || encoding == "32FC1";
}

ImageKind kindOf(std::string_view encoding, bool compressed) {
  if (compressed) {
    if (encoding.find("compressedDepth") != std::string_view::npos) return ImageKind::kDepth;
    if (startsLikeDepth(encoding.substr(0, encoding.find(';')))) return ImageKind::kDepth;
    return encoding.starts_with("mono8") ? ImageKind::kGrey : ImageKind::kColor;
  }
  if (startsLikeDepth(encoding)) return ImageKind::kDepth;
  if (encoding == "mono8") return ImageKind::kGrey;
  const bool known = std::any_of(kLayouts.begin(), kLayouts.end(),
                                 [&](const PixelLayout& layout) { return layout.encoding == encoding; });
  return known ? ImageKind::kColor : ImageKind::kOther;
}

struct MessageHeader {
  common::Time stamp;
  std::string_view frame;
};

MessageHeader takeHeader(const BagMessage& message, MessageCursor& cursor) {
  (void)cursor.u32();  // Sequence number.
  const std::int64_t seconds = cursor.u32(), nanoseconds = cursor.u32();
  const common::Time stamp = seconds == 0 && nanoseconds == 0
                                 ? message.recorded
                                 : common::Time::fromNanoseconds(seconds * 1'000'000'000 + nanoseconds);
  return {stamp, cursor.text()};
}

/// A raw image as its message has it: rows of `step` bytes.
struct RawImage {
  std::uint32_t height_px = 0, width_px = 0, step = 0;
  std::string_view encoding, bytes;
  bool is_big_endian = false;
};

ImageFault imageCutOff() { return {Message("image.cut-off", "is cut off"), true}; }

tl::expected<RawImage, ImageFault> rawImage(const BagMessage& message, std::size_t bytes_a_pixel_at_least) {
  MessageCursor cursor(message.data);
  (void)takeHeader(message, cursor);
  RawImage raw;
  raw.height_px = cursor.u32();
  raw.width_px = cursor.u32();
  raw.encoding = cursor.text();
  const std::string_view big = cursor.bytes(1);
  raw.is_big_endian = !big.empty() && big.front() != 0;
  raw.step = cursor.u32();
  raw.bytes = cursor.text();
  if (!cursor.whole()) return unexpected(imageCutOff());
  const auto most = static_cast<std::uint32_t>(common::kMostImageSide_px);
  if (raw.width_px == 0 || raw.height_px == 0 || raw.width_px > most || raw.height_px > most)
    return unexpected(ImageFault{
        Message("image.too-large", "is {}x{} pixels large, 1 to {} can be read", raw.width_px, raw.height_px, most)});
  if (raw.step < bytes_a_pixel_at_least * raw.width_px ||
      raw.bytes.size() < std::size_t{raw.step} * (raw.height_px - 1) + bytes_a_pixel_at_least * raw.width_px)
    return unexpected(imageCutOff());
  return raw;
}

tl::expected<Image, ImageFault> rawColor(const BagMessage& message) {
  auto raw = rawImage(message, 1);
  if (!raw) return unexpected(std::move(raw.error()));
  const auto* layout = std::find_if(kLayouts.begin(), kLayouts.end(),
                                    [&](const PixelLayout& known) { return known.encoding == raw->encoding; });
  if (layout == kLayouts.end())
    return unexpected(
        ImageFault{Message("image.encoding", "has the encoding `{}`, which is not read", shown(raw->encoding))});
  raw = rawImage(message, layout->bytes);
  if (!raw) return unexpected(std::move(raw.error()));
  Image image{static_cast<int>(raw->width_px), static_cast<int>(raw->height_px), {}};
  image.rgb.reserve(std::size_t{3} * raw->width_px * raw->height_px);
  for (std::size_t v = 0; v < raw->height_px; ++v)
    for (std::size_t u = 0; u < raw->width_px; ++u) {
      const char* pixel = raw->bytes.data() + v * raw->step + u * layout->bytes;
      for (const std::size_t at : {layout->red, layout->green, layout->blue})
        image.rgb.push_back(static_cast<std::uint8_t>(pixel[at]));
    }
  return image;
}

/// The format and the data of a compressed image.
struct PackedImage {
  std::string_view format, bytes;
};

tl::expected<PackedImage, ImageFault> packedImage(const BagMessage& message) {
  MessageCursor cursor(message.data);
  (void)takeHeader(message, cursor);
  const std::string_view format = cursor.text(), bytes = cursor.text();
  if (!cursor.whole()) return unexpected(imageCutOff());
  return PackedImage{format, bytes};
}

/// OpenCV writes blue before red, but PNG and JPEG files say what they hold.
tl::expected<Image, ImageFault> packedColor(const BagMessage& message) {
  return packedImage(message).and_then([](const PackedImage& packed) { return common::decodeColor(packed.bytes); });
}

std::uint16_t codeOfMetres(float depth_m) {
  const double code = static_cast<double>(depth_m) * kFloatUnits_per_m;
  return code > 0.0 && code < 65535.0 ? static_cast<std::uint16_t>(std::lround(code)) : std::uint16_t{0};
}

std::uint32_t pixelAt(const char* bytes, int count, bool is_big_endian) {
  std::uint32_t number = 0;
  for (int i = 0; i < count; ++i) {
    const auto byte = static_cast<unsigned char>(bytes[is_big_endian ? i : count - 1 - i]);
    number = number << 8 | byte;
  }
  return number;
}

/// The numbers of all pixels, of two or four bytes each.
std::vector<std::uint32_t> numbersOf(const RawImage& raw, int bytes) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(std::size_t{raw.width_px} * raw.height_px);
  for (std::size_t v = 0; v < raw.height_px; ++v)
    for (std::size_t u = 0; u < raw.width_px; ++u)
      numbers.push_back(
          pixelAt(raw.bytes.data() + v * raw.step + u * static_cast<std::size_t>(bytes), bytes, raw.is_big_endian));
  return numbers;
}

/// Some programs write millimetres where metres belong: an image whose depths are mostly farther than a camera sees.
float floatUnit_m(const std::vector<std::uint32_t>& numbers) {
  constexpr float kFartherThanAnyCamera_m = 60.0F;
  std::size_t measured = 0, far = 0;
  for (const std::uint32_t number : numbers) {
    const auto depth = std::bit_cast<float>(number);
    if (!(depth > 0.0F) || !std::isfinite(depth)) continue;
    ++measured;
    far += depth > kFartherThanAnyCamera_m ? 1 : 0;
  }
  return 2 * far > measured ? 1e-3F : 1.0F;
}

tl::expected<DepthCodes, ImageFault> rawDepth(const BagMessage& message) {
  auto raw = rawImage(message, 2);
  if (!raw) return unexpected(std::move(raw.error()));
  const bool is_float = raw->encoding == "32FC1";
  if (is_float) raw = rawImage(message, 4);
  if (!raw) return unexpected(std::move(raw.error()));
  const std::vector<std::uint32_t> numbers = numbersOf(*raw, is_float ? 4 : 2);
  const float unit_m = is_float ? floatUnit_m(numbers) : 0.0F;
  DepthCodes depth{static_cast<int>(raw->width_px), static_cast<int>(raw->height_px), {}};
  depth.codes.reserve(numbers.size());
  for (const std::uint32_t number : numbers)
    depth.codes.push_back(is_float ? codeOfMetres(unit_m * std::bit_cast<float>(number))
                                   : static_cast<std::uint16_t>(number));
  return depth;
}

/// compressed_depth_image_transport: a number that names the packing and two of its quantization, then a PNG. Depths in
/// metres are stored inversely, depth = a / (code - b).
tl::expected<DepthCodes, ImageFault> packedDepth(const BagMessage& message) {
  const auto packed = packedImage(message);
  if (!packed) return unexpected(packed.error());
  if (packed->format.find("compressedDepth") == std::string_view::npos) return common::decodeDepth(packed->bytes);
  if (packed->format.find("rvl") != std::string_view::npos)
    return unexpected(ImageFault{Message("image.rvl", "is packed by RVL, which is not read")});
  MessageCursor cursor(packed->bytes);
  (void)cursor.u32();
  const double a = cursor.f32(), b = cursor.f32();
  auto depth = common::decodeDepth(cursor.bytes(cursor.left()));
  if (!depth || !packed->format.starts_with("32FC1")) return depth;
  for (std::uint16_t& code : depth->codes)
    code = code == 0 ? std::uint16_t{0} : codeOfMetres(static_cast<float>(a / (code - b)));
  return depth;
}

double f64(MessageCursor& cursor) {
  const std::uint64_t low = cursor.u32(), high = cursor.u32();
  return std::bit_cast<double>(low | high << 32);
}

std::vector<double> takeNumbers(MessageCursor& cursor, std::size_t count) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count && cursor.whole(); ++i) numbers.push_back(f64(cursor));
  return numbers;
}

Message notRead(const std::string& why) { return Message("camera-info.not-read", "its CameraInfo {}", why); }

}  // namespace

bool isImage(const BagConnection& connection) { return isOf(connection, "sensor_msgs/Image", kImageMd5); }
bool isCompressedImage(const BagConnection& connection) {
  return isOf(connection, "sensor_msgs/CompressedImage", kCompressedMd5);
}
bool isCameraInfo(const BagConnection& connection) {
  return isOf(connection, "sensor_msgs/CameraInfo", kCameraInfoMd5);
}

std::optional<ImageHeader> imageHeader(const BagMessage& message) {
  MessageCursor cursor(message.data);
  const MessageHeader header = takeHeader(message, cursor);
  const bool compressed = isCompressedImage(*message.connection);
  if (!compressed) (void)cursor.bytes(8);  // Height and width.
  const std::string_view encoding = cursor.text();
  if (!cursor.whole()) return std::nullopt;
  return ImageHeader{header.stamp, std::string(header.frame), std::string(encoding), kindOf(encoding, compressed)};
}

tl::expected<Image, ImageFault> colorOf(const BagMessage& message) {
  return isCompressedImage(*message.connection) ? packedColor(message) : rawColor(message);
}

tl::expected<DepthCodes, ImageFault> depthOf(const BagMessage& message) {
  return isCompressedImage(*message.connection) ? packedDepth(message) : rawDepth(message);
}

tl::expected<CameraInfo, Message> cameraInfoOf(const BagMessage& message) {
  MessageCursor cursor(message.data);
  CameraInfo info;
  info.frame = std::string(takeHeader(message, cursor).frame);
  const std::uint32_t height_px = cursor.u32(), width_px = cursor.u32();
  const std::string_view model = cursor.text();
  const std::uint32_t parameters = cursor.u32();
  if (parameters > cursor.left() / sizeof(double)) return unexpected(notRead("is cut"));
  std::vector<double> D = takeNumbers(cursor, parameters);
  const std::vector<double> K = takeNumbers(cursor, 9);
  (void)takeNumbers(cursor, 9);  // Rotation to the rectified image.
  const std::vector<double> P = takeNumbers(cursor, 12);
  if (!cursor.whole()) return unexpected(notRead("is cut"));
  const bool is_known = model.empty() || model == "plumb_bob" || model == "rational_polynomial";
  const auto isDistorted = [&](std::size_t from) {
    return from < D.size() && std::any_of(D.begin() + static_cast<std::ptrdiff_t>(from), D.end(),
                                          [](double value) { return value != 0.0; });
  };
  if (isDistorted(is_known ? 5 : 0))
    return unexpected(notRead(fmt::format("has a distortion of the kind `{}`, which is not known here", shown(model))));
  D.resize(5, 0.0);
  if (std::max(width_px, height_px) > static_cast<std::uint32_t>(common::kMostImageSide_px))
    return unexpected(notRead("has a size that no camera has"));
  info.raw = {
      static_cast<int>(width_px), static_cast<int>(height_px), K[0], K[4], K[2], K[5], D[0], D[1], D[2], D[3], D[4]};
  info.rectified = {static_cast<int>(width_px), static_cast<int>(height_px), P[0], P[5], P[2], P[6]};
  if (P[0] == 0.0) {
    info.rectified = info.raw;
    info.rectified.k1 = info.rectified.k2 = info.rectified.p1 = info.rectified.p2 = info.rectified.k3 = 0.0;
  }
  for (const LensCalibration& lens : {info.raw, info.rectified})
    if (const auto problems = common::config::problemsOf(lens); !problems.empty())
      return unexpected(notRead(fmt::format("is not that of a camera: {}", common::toString(problems.front()))));
  return info;
}

}  // namespace swiftlet::interfaces
