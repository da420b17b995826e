// Colours in the ranges that tools use: 0 to 255, 0 to 1, and 0 to 65535.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/submap3d.hpp"

namespace swiftlet::interfaces {

/// Red, green and blue as a file has them.
using RawColor = std::array<float, 3>;

/// How the numbers of colours are usually read where their type is known.
enum class ColorType { kByte, kShort, kFloat };

/// Sets the colours of the points, one raw colour each, as 0 to 255. The type of a column does not fix the range: 16
/// bits often hold 0 to 255, and so do floats. So the greatest number of all decides: the range is the least one that
/// reaches half as far or farther, because interpolated colours go a little beyond their range. What is beyond is cut
/// off. Colours that are not finite, and all colours where no range fits, are common::kUnknownColor.
/// Returns a note for people if the range is not the usual one of the type, or is coarser here, or if colours are below
/// 0 or not finite; empty otherwise.
std::string setColors(const std::vector<RawColor>& colors, ColorType type, std::vector<common::SurfacePoint>& points);

}  // namespace swiftlet::interfaces
