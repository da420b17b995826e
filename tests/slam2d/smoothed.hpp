#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::test {

/// Each point becomes the mean of itself and `half` neighbours on either side; the last point is repeated at the ends.
inline std::vector<Eigen::Vector2d> smoothed(const std::vector<Eigen::Vector2d>& in, int half) {
  std::vector<Eigen::Vector2d> out(in.size());
  for (int i = 0; i < static_cast<int>(in.size()); ++i) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int k = -half; k <= half; ++k)
      sum += in[static_cast<std::size_t>(std::clamp(i + k, 0, static_cast<int>(in.size()) - 1))];
    out[static_cast<std::size_t>(i)] = sum / (2 * half + 1);
  }
  return out;
}

}  // namespace swiftlet::test
