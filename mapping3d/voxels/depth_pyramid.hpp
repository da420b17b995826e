// The least and the greatest value in rectangles of an image, in constant time.
#pragma once

#include <algorithm>
#include <bit>
#include <vector>

#include "common/row_major.hpp"

namespace swiftlet::mapping3d {

/// Level k holds, for each pixel, the least or the greatest value of the square of side 2^k whose top left it is;
/// squares that reach beyond the image are cut at its edge.
class DepthPyramid {
 public:
  enum class Of { kLeast, kGreatest };

  /// Squares have sides of up to `side_max`.
  DepthPyramid(Of of, int side_max);

  /// Another image, row by row, of which each square of `group_px` by `group_px` pixels (1 or 2) is one here. The
  /// memory of the last one is used again.
  void build(const std::vector<float>& image_m, int width_px, int height_px, int group_px);

  /// The squares of one side.
  struct Squares {
    const float* values;
    int width;
    int side;
    float at(int u, int v) const { return values[v * width + u]; }
  };
  /// The squares of the greatest side that is not above this one, which must be at least 1.
  Squares squaresOf(int side) const {
    const int level = levelOf(side);
    return {levels_[static_cast<std::size_t>(level)].data(), width_px_, 1 << level};
  }

  /// The value of the rectangle [u_first, u_last] x [v_first, v_last], which must be pixels of the image and not empty.
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
  template <typename MoreExtreme>
  void buildWith(const std::vector<float>& image_m, int width_px, int height_px, int group_px, MoreExtreme extreme);
  std::size_t index(int u, int v) const { return common::rowMajor(v, width_px_, u); }
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
