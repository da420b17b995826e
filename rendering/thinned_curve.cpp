#include "rendering/thinned_curve.hpp"

#include <algorithm>

namespace swiftlet::rendering {

void ThinnedCurve::add(double x, double y) {
  const bool complete = points_.empty() || in_last_ == stride_;
  if (complete && points_.size() == kPoints) joinPairs();
  if (complete) {
    points_.emplace_back(x, y);
    in_last_ = 1;
  } else {
    points_.back().y() = std::max(points_.back().y(), y);
    ++in_last_;
  }
}

void ThinnedCurve::joinPairs() {
  static_assert(kPoints % 2 == 0, "each point has its partner");
  for (std::size_t i = 0; i < kPoints / 2; ++i)
    points_[i] = {points_[2 * i].x(), std::max(points_[2 * i].y(), points_[2 * i + 1].y())};
  points_.resize(kPoints / 2);
  stride_ *= 2;
}

}  // namespace swiftlet::rendering
