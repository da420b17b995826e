// Exact horizontal distance between an upright sweep and a triangle.
#pragma once

#include <array>

#include <Eigen/Core>

namespace swiftlet::simulation {

struct Nearest2d {
  double distance_m = 0.0;
  Eigen::Vector2d point_m = Eigen::Vector2d::Zero();  ///< On the triangle.
};

struct Segment2d {
  Eigen::Vector2d from_m;
  Eigen::Vector2d to_m;
};

/// The part of a triangle between two heights, seen from above: a convex polygon of at most 5 corners, possibly flat.
class Slice {
 public:
  Slice(const std::array<Eigen::Vector3d, 3>& triangle_m, double bottom_m, double top_m);
  bool empty() const { return size_ == 0; }
  /// The slice must not be empty.
  Nearest2d nearestTo(const Segment2d& segment) const;
  /// Height of the slice's middle.
  double height_m() const;

 private:
  void clip(double height_m, double side);
  bool contains(const Eigen::Vector2d& point_m) const;

  std::array<Eigen::Vector3d, 8> corners_;
  int size_ = 3;
};

}  // namespace swiftlet::simulation
