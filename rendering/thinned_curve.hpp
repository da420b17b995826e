// A curve with more values than can be stored.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::rendering {

/// At most kPoints points for any number of values. Neighbours are merged to one point at the x of the first, with the
/// greatest of their y.
class ThinnedCurve {
 public:
  static constexpr std::size_t kPoints = 2000;

  void add(double x, double y);
  const std::vector<Eigen::Vector2d>& points() const { return points_; }

 private:
  void joinPairs();

  std::vector<Eigen::Vector2d> points_;
  int stride_ = 1;   ///< Number of values in a point.
  int in_last_ = 0;  ///< Number of values in the last point; the other points are complete.
};

}  // namespace swiftlet::rendering
