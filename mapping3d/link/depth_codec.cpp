#include "mapping3d/link/depth_codec.hpp"

#include <bit>
#include <cmath>
#include <optional>

#include <zstd.h>

#include "common/check.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::DepthImage;

/// The first byte: what the numbers are. Whole millimetres are computed with double or with single precision, as the
/// camera's driver does it; the bits of the result differ.
enum Kind : std::uint8_t { kMillimetres = 1, kSingleMillimetres = 2, kBits = 3 };
std::size_t bytesOf(Kind kind) { return kind == kBits ? 4 : 2; }

constexpr std::uint32_t kTooFarCode = 65535;
/// Level 1 packs several times as fast as the default of zstd.
constexpr int kLevel = 1;

float depthOf(std::uint32_t code, Kind kind) {
  if (kind == kBits) return std::bit_cast<float>(code);
  if (code == kTooFarCode) return DepthImage::kTooFar;
  return kind == kMillimetres ? static_cast<float>(code / 1000.0) : 0.001F * static_cast<float>(code);
}

/// nullopt if a depth is not a whole number of millimetres of that kind.
std::optional<std::vector<std::uint32_t>> inMillimetres(const DepthImage& depth, Kind kind) {
  std::vector<std::uint32_t> codes;
  codes.reserve(depth.depth_m.size());
  for (const float depth_m : depth.depth_m) {
    std::uint32_t code = kTooFarCode;
    if (depth_m != DepthImage::kTooFar) {
      if (!(depth_m >= 0.0F && depth_m < 65.0F)) return std::nullopt;
      code = static_cast<std::uint32_t>(std::lround(1000.0 * static_cast<double>(depth_m)));
    }
    if (std::bit_cast<std::uint32_t>(depthOf(code, kind)) != std::bit_cast<std::uint32_t>(depth_m)) return std::nullopt;
    codes.push_back(code);
  }
  return codes;
}

/// Small differences of either sign become small numbers; as many bits as the number has.
std::uint32_t folded(std::uint32_t difference, Kind kind) {
  if (kind != kBits) difference = static_cast<std::uint32_t>(static_cast<std::int16_t>(difference));
  const std::uint32_t sign = static_cast<std::uint32_t>(static_cast<std::int32_t>(difference) >> 31);
  return (difference << 1U) ^ sign;
}
std::uint32_t unfolded(std::uint32_t number) { return (number >> 1U) ^ (0U - (number & 1U)); }

}  // namespace

std::vector<std::uint8_t> encodeDepth(const DepthImage& depth) {
  const std::size_t pixels = depth.depth_m.size();
  Kind kind = kMillimetres;
  std::optional<std::vector<std::uint32_t>> codes = inMillimetres(depth, kind);
  if (!codes) codes = inMillimetres(depth, kind = kSingleMillimetres);
  if (!codes) {
    kind = kBits;
    codes.emplace();
    for (const float depth_m : depth.depth_m) codes->push_back(std::bit_cast<std::uint32_t>(depth_m));
  }
  std::vector<std::uint8_t> planes(pixels * bytesOf(kind));
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint32_t number = folded((*codes)[i] - last, kind);
    last = (*codes)[i];
    for (std::size_t plane = 0; plane < bytesOf(kind); ++plane)
      planes[plane * pixels + i] = static_cast<std::uint8_t>(number >> (8 * plane));
  }
  std::vector<std::uint8_t> bytes(1 + ZSTD_compressBound(planes.size()));
  bytes[0] = kind;
  const std::size_t size = ZSTD_compress(bytes.data() + 1, bytes.size() - 1, planes.data(), planes.size(), kLevel);
  SWIFTLET_CHECK(ZSTD_isError(size) == 0U, ZSTD_getErrorName(size));
  bytes.resize(1 + size);
  return bytes;
}

tl::expected<DepthImage, std::string> decodeDepth(std::span<const std::uint8_t> bytes, int width_px, int height_px) {
  if (width_px <= 0 || height_px <= 0) return tl::unexpected(std::string("has no pixels"));
  if (bytes.empty() || bytes[0] < kMillimetres || bytes[0] > kBits)
    return tl::unexpected(std::string("is no packed depth image"));
  const auto kind = static_cast<Kind>(bytes[0]);
  const std::size_t pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  std::vector<std::uint8_t> planes(pixels * bytesOf(kind));
  const std::size_t size = ZSTD_decompress(planes.data(), planes.size(), bytes.data() + 1, bytes.size() - 1);
  if (ZSTD_isError(size) != 0U) return tl::unexpected(std::string("cannot be unpacked: ") + ZSTD_getErrorName(size));
  if (size != planes.size()) return tl::unexpected(std::string("has too few pixels"));
  DepthImage depth{width_px, height_px, std::vector<float>(pixels)};
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    std::uint32_t number = 0;
    for (std::size_t plane = 0; plane < bytesOf(kind); ++plane)
      number |= static_cast<std::uint32_t>(planes[plane * pixels + i]) << (8 * plane);
    last += unfolded(number);
    if (kind != kBits) last &= 0xFFFFU;
    depth.depth_m[i] = depthOf(last, kind);
  }
  return depth;
}

}  // namespace swiftlet::mapping3d
