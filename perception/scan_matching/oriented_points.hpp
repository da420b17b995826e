// The contours of a reference as points with normals, evenly spaced, with a search for the nearest point that faces the
// same side.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "perception/scan_matching/contour_normals.hpp"

namespace swiftlet::perception {

/// Not thread-safe while points are added or sorted; concurrent reading is safe.
class OrientedPoints {
 public:
  /// Least distance between two points of a scan: the accuracy of a UTM-30LX. Denser points add cost and no accuracy.
  static constexpr double kSpacing_m = 0.03;
  static constexpr int kNone = -1;

  void clear();
  /// Adds the points of a scan, which must be in beam order. Points denser than the spacing are thinned out. Where
  /// neighbours are sparser, lie on one surface and are no farther apart than `max_gap_m`, the line between them is
  /// filled.
  void add(std::span<const OrientedPoint> scan, const common::Pose2& T_reference_body, double max_gap_m);
  /// Sorts the points into cells. Call it after adding and before searching.
  void sort();

  bool empty() const { return points_.empty(); }
  const Eigen::Vector2d& point_m(int index) const { return points_[static_cast<std::size_t>(index)].point_m; }
  const Eigen::Vector2d& normal(int index) const { return points_[static_cast<std::size_t>(index)].normal; }

  /// The nearest point within the radius whose normal is within 45 degrees of the given one, or kNone. Among equally
  /// near points the choice is repeatable.
  int nearest(const Eigen::Vector2d& at_m, const Eigen::Vector2d& normal, double radius_m) const;

 private:
  struct Entry {
    Eigen::Vector2d point_m, normal;
  };

  std::vector<Entry> points_;
  bool sorted_ = false;
  Eigen::Vector2d begin_m_ = Eigen::Vector2d::Zero();
  double cell_m_ = 1.0;
  int columns_ = 0, rows_ = 0;
  std::vector<int> first_;  ///< Index of the first point of each cell, row by row, and the total count at the end.
};

}  // namespace swiftlet::perception
