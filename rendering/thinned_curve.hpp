// A curve to be drawn of more values than can be kept.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::rendering {

/// At most kPoints points, whatever the number of values: neighbours are joined to one point at the first one's x, with
/// the greatest of their y.
class ThinnedCurve {
 public:
  static constexpr std::size_t kPoints = 2000;

  void add(double x, double y);
  const std::vector<Eigen::Vector2d>& points() const { return points_; }

 private:
  void joinPairs();

  std::vector<Eigen::Vector2d> points_;
  int stride_ = 1;   ///< Values a point.
  int in_last_ = 0;  ///< Values of the last point; the others are complete.
};

}  // namespace swiftlet::rendering
