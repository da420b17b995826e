// Clouds of coloured points in the Polygon File Format, binary and little-endian, as MeshLab, CloudCompare and Open3D
// open it.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <Eigen/Core>

namespace swiftlet::interfaces {

struct ColoredPoint {
  Eigen::Vector3f point_m;
  std::uint8_t red = 0, green = 0, blue = 0;
};

/// The bytes of the file. Equal points give equal bytes on every machine.
std::string toPly(std::span<const ColoredPoint> points);

}  // namespace swiftlet::interfaces
