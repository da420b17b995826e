// The contours of a reference as points with normals, evenly dense, and the nearest of them that faces the same way.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "perception/scan_matching/contour_normals.hpp"

namespace swiftlet::perception {

/// Not thread-safe while it is added to; reading is.
class OrientedPoints {
 public:
  static constexpr double kSpacing_m = 0.03;
  static constexpr int kNone = -1;

  void clear();
  /// All points of a scan in beam order: where they are denser than the spacing some are left out, and where they are
  /// sparser, but no farther apart than `max_gap_m` and of one surface, the line between them is filled.
  void add(std::span<const OrientedPoint> scan, const common::Pose2& T_reference_body, double max_gap_m);
  /// Sorts the points into cells; due after adding and before searching.
  void sort();

  bool empty() const { return points_.empty(); }
  const Eigen::Vector2d& point_m(int index) const { return points_[static_cast<std::size_t>(index)].point_m; }
  const Eigen::Vector2d& normal(int index) const { return points_[static_cast<std::size_t>(index)].normal; }

  /// The nearest point within the radius whose normal is within 45 degrees of the given one, or kNone; of equally near
  /// ones always the same.
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
  std::vector<int> first_;  ///< Of each cell, row by row, the index of its first point; and one more.
};

}  // namespace swiftlet::perception
