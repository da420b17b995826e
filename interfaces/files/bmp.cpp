#include "interfaces/files/bmp.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

namespace swiftlet::interfaces {
namespace {

using common::Message;
using tl::unexpected;

constexpr std::size_t kFileHeaderBytes = 14;
constexpr std::size_t kCoreHeaderBytes = 12;  ///< That of OS/2, with sides of 16 bits and three bytes a colour.
constexpr std::size_t kMasksAt = kFileHeaderBytes + 40;
constexpr std::uint32_t kPlain = 0, kRle8 = 1, kRle4 = 2, kMasks = 3, kMasksWithAlpha = 6;

/// A number of `count` bytes, the lowest first; what lies behind the end is 0.
std::uint32_t number(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count && at + i < bytes.size(); ++i)
    value |= std::uint32_t{static_cast<std::uint8_t>(bytes[at + i])} << (8 * i);
  return value;
}

struct Header {
  std::size_t bytes = 0;
  std::int64_t width_px = 0, height_px = 0;
  bool top_down = false;
  std::size_t bits = 0;
  std::uint32_t packing = kPlain;
  std::uint32_t red = 0, green = 0, blue = 0, alpha = 0;  ///< The bits of each channel in a pixel of 16 bits or more.
};

void readMasks(std::string_view bytes, Header& header) {
  if (header.packing == kMasks || header.packing == kMasksWithAlpha) {
    header.red = number(bytes, kMasksAt, 4);
    header.green = number(bytes, kMasksAt + 4, 4);
    header.blue = number(bytes, kMasksAt + 8, 4);
    if (header.bytes >= 56 || header.packing == kMasksWithAlpha) header.alpha = number(bytes, kMasksAt + 12, 4);
  } else if (header.bits == 16) {
    header.red = 0x7c00, header.green = 0x3e0, header.blue = 0x1f;
  } else {
    header.red = 0xff0000, header.green = 0xff00, header.blue = 0xff;
  }
}

Header headerOf(std::string_view bytes) {
  Header header;
  header.bytes = number(bytes, kFileHeaderBytes, 4);
  const bool is_core = header.bytes == kCoreHeaderBytes;
  const std::size_t side = is_core ? 2 : 4, at = kFileHeaderBytes + 4;
  header.width_px = number(bytes, at, side);
  const std::uint32_t height = number(bytes, at + side, side);
  header.height_px = is_core ? std::int64_t{height} : std::int64_t{static_cast<std::int32_t>(height)};
  header.top_down = header.height_px < 0;
  header.height_px = std::abs(header.height_px);
  header.bits = number(bytes, at + 2 * side + 2, 2);
  if (!is_core) header.packing = number(bytes, kFileHeaderBytes + 16, 4);
  readMasks(bytes, header);
  return header;
}

/// Why it cannot be read; nullopt if it can.
std::optional<Message> problemOf(const Header& header) {
  if (header.packing == kRle8 || header.packing == kRle4)
    return Message("bmp.run-lengths", "is compressed by run lengths (RLE{})", header.packing == kRle8 ? 8 : 4);
  if (header.packing != kPlain && header.packing != kMasks && header.packing != kMasksWithAlpha)
    return Message("bmp.other-packing", "is compressed in a way (number {}) that cannot be read", header.packing);
  if (header.bytes != kCoreHeaderBytes && header.bytes < 40)
    return Message("bmp.other-header", "has a header of {} bytes, which no BMP has", header.bytes);
  constexpr std::size_t kBits[] = {1, 4, 8, 16, 24, 32};
  if (std::find(std::begin(kBits), std::end(kBits), header.bits) == std::end(kBits))
    return Message("bmp.other-depth", "has {} bits a pixel, which no BMP has", header.bits);
  if (std::min(header.width_px, header.height_px) < 1 ||
      std::max(header.width_px, header.height_px) > common::kMostGreySide_px)
    return Message("image.too-large", "is {}x{} pixels large, 1 to {} can be read", header.width_px, header.height_px,
                   common::kMostGreySide_px);
  return std::nullopt;
}

/// The bits of a mask as a number from 0 to 255.
int channel(std::uint32_t pixel, std::uint32_t mask) {
  if (mask == 0) return 0;
  const int shift = std::countr_zero(mask);
  const std::uint64_t most = mask >> shift, value = (pixel & mask) >> shift;
  return static_cast<int>((2 * 255 * value + most) / (2 * most));
}

std::uint8_t meanOf(int red, int green, int blue) {
  return static_cast<std::uint8_t>((2 * (red + green + blue) + 3) / 6);
}

/// The brightness of each colour of the palette, which ends where the pixels begin. A colour that is not in it is
/// black.
std::vector<std::uint8_t> paletteOf(std::string_view bytes, const Header& header) {
  std::vector<std::uint8_t> palette;
  const std::size_t entry = header.bytes == kCoreHeaderBytes ? 3 : 4;
  std::size_t at = kFileHeaderBytes + header.bytes;
  for (std::size_t i = 0; i < (std::size_t{1} << header.bits); ++i, at += entry)
    palette.push_back(meanOf(static_cast<int>(number(bytes, at, 1)), static_cast<int>(number(bytes, at + 1, 1)),
                             static_cast<int>(number(bytes, at + 2, 1))));
  return palette;
}

void addRow(std::string_view row, const Header& header, const std::vector<std::uint8_t>& palette,
            common::GreyImage& image) {
  for (std::size_t x = 0; x < static_cast<std::size_t>(header.width_px); ++x) {
    if (header.bits <= 8) {
      const std::size_t at = x * header.bits;
      const std::uint32_t shifted = number(row, at / 8, 1) >> (8 - header.bits - at % 8);
      image.brightness.push_back(palette[shifted & ((1U << header.bits) - 1)]);
      continue;
    }
    const std::uint32_t pixel = number(row, x * header.bits / 8, header.bits / 8);
    image.brightness.push_back(
        meanOf(channel(pixel, header.red), channel(pixel, header.green), channel(pixel, header.blue)));
    if (header.alpha != 0) image.opacity.push_back(static_cast<std::uint8_t>(channel(pixel, header.alpha)));
  }
}

}  // namespace

tl::expected<common::GreyImage, common::ImageFault> decodeBmp(std::string_view bytes) {
  const Header header = headerOf(bytes);
  if (auto problem = problemOf(header)) return unexpected(common::ImageFault{*std::move(problem)});
  const auto width = static_cast<std::size_t>(header.width_px), height = static_cast<std::size_t>(header.height_px);
  const std::size_t begin = std::min<std::size_t>(number(bytes, 10, 4), bytes.size());
  // Each row takes whole words; some programs leave out the padding of the last.
  const std::size_t stride = (width * header.bits + 31) / 32 * 4;
  const std::size_t needed = stride * (height - 1) + (width * header.bits + 7) / 8;
  if (bytes.size() - begin < needed)
    return unexpected(common::ImageFault{
        Message("bmp.cut", "ends after {} of {} bytes of its pixels", bytes.size() - begin, needed), true});
  common::GreyImage image{static_cast<int>(width), static_cast<int>(height), {}, {}};
  image.brightness.reserve(width * height);
  const std::vector<std::uint8_t> palette =
      header.bits <= 8 ? paletteOf(bytes.substr(0, begin), header) : std::vector<std::uint8_t>();
  for (std::size_t row = 0; row < height; ++row)
    addRow(bytes.substr(begin + (header.top_down ? row : height - 1 - row) * stride, stride), header, palette, image);
  // Programs that know no opacity leave it 0.
  if (std::all_of(image.opacity.begin(), image.opacity.end(), [](std::uint8_t alpha) { return alpha == 0; }))
    image.opacity.clear();
  return image;
}

}  // namespace swiftlet::interfaces
