#include "interfaces/files/ply.hpp"

#include <bit>

#include <fmt/format.h>

namespace swiftlet::interfaces {
namespace {

void append(std::string& bytes, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>((bits >> shift) & 0xffU));
}

}  // namespace

std::string toPly(std::span<const ColoredPoint> points) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment metres\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
      points.size());
  bytes.reserve(bytes.size() + 15 * points.size());
  for (const ColoredPoint& point : points) {
    for (const float coordinate_m : {point.point_m.x(), point.point_m.y(), point.point_m.z()})
      append(bytes, coordinate_m);
    for (const std::uint8_t color : {point.red, point.green, point.blue}) bytes.push_back(static_cast<char>(color));
  }
  return bytes;
}

}  // namespace swiftlet::interfaces
