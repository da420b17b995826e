// The inner loop of correlative matching. At a fixed rotation, the scores of all translations are the sum of one small
// window of the likelihood field per point (Bachrach 2009, section 5.1.2). There is one version per instruction set,
// chosen at run time; all add integers and give the same bits.
#pragma once

#include <cstdint>
#include <span>

namespace swiftlet::perception {

enum class Instructions { kScalar, kSse41, kAvx2 };
/// The best instruction set of this machine.
Instructions bestInstructions();
bool isAvailable(Instructions instructions);
const char* toString(Instructions instructions);

inline constexpr int kWindowColumns = 16;

/// Index, among the sums, of the window that begins at (x, y).
constexpr std::size_t windowIndex(int x, int y) {
  return static_cast<std::size_t>(y) * kWindowColumns + static_cast<std::size_t>(x);
}
/// The sum of this many bytes fits into 16 bits.
inline constexpr int kMaxWindowPoints = 257;

/// sums[row * 16 + column] = sum over the points of cells[offsets[i] + row * stride + column], for 16 columns.
/// At most kMaxWindowPoints points. Every byte read must be addressable, also in columns the caller does not use.
void sumWindows(Instructions instructions, const std::uint8_t* cells, int stride, std::span<const std::int32_t> offsets,
                int rows, std::uint16_t* sums);

/// The cell of each point after rotation and translation: x = floor(cos * points_x - sin * points_y + shift_x), y
/// likewise. All results must fit into 32 bits; the spans have equal length.
void transformToCells(std::span<const float> points_x, std::span<const float> points_y, float cosine, float sine,
                      float shift_x, float shift_y, std::span<std::int32_t> cells_x, std::span<std::int32_t> cells_y);

}  // namespace swiftlet::perception
