// The least and the greatest value in rectangles of an image, in constant time.
#pragma once

#include <algorithm>
#include <bit>
#include <vector>

namespace swiftlet::mapping3d {

/// Level k holds, for each pixel, the least or the greatest value of the square of side 2^k whose top left it is;
/// squares that reach beyond the image are cut at its edge.
class DepthPyramid {
 public:
  enum class Of { kLeast, kGreatest };

  /// Squares have sides of up to `side_max`.
  DepthPyramid(Of of, int side_max);

  /// Another image, row by row. The memory of the last one is used again.
  void build(const std::vector<float>& image_m, int width_px, int height_px);

  float at(int u, int v) const { return levels_.front()[index(u, v)]; }

  /// The value of a square within [u_first, u_last] x [v_first, v_last], which must be pixels of the image and not
  /// empty. Its corner is the first pixel, and its side at least half of the rectangle's shorter one up to `side_max`.
  float inSquareWithin(int u_first, int v_first, int u_last, int v_last) const {
    const int level = levelOf(std::min(u_last - u_first, v_last - v_first) + 1);
    return levels_[static_cast<std::size_t>(level)][index(u_first, v_first)];
  }

  /// The value of the rectangle, under the same conditions.
  float inRectangle(int u_first, int v_first, int u_last, int v_last) const {
    const int level = levelOf(std::min(u_last - u_first, v_last - v_first) + 1), side = 1 << level;
    const std::vector<float>& squares = levels_[static_cast<std::size_t>(level)];
    float extreme = squares[index(u_first, v_first)];
    for (int v = v_first;; v = std::min(v + side, v_last + 1 - side)) {
      for (int u = u_first;; u = std::min(u + side, u_last + 1 - side)) {
        extreme = moreExtreme(extreme, squares[index(u, v)]);
        if (u + side > u_last) break;
      }
      if (v + side > v_last) break;
    }
    return extreme;
  }

 private:
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px_) + static_cast<std::size_t>(u);
  }
  int levelOf(int side) const {
    const auto level = static_cast<int>(std::bit_width(static_cast<unsigned>(side))) - 1;
    return std::min(level, static_cast<int>(levels_.size()) - 1);
  }
  float moreExtreme(float a, float b) const { return of_ == Of::kLeast ? std::min(a, b) : std::max(a, b); }

  Of of_;
  int width_px_ = 0;
  std::vector<std::vector<float>> levels_;
};

}  // namespace swiftlet::mapping3d
