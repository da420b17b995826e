// What a scan sees, placed in the map: its end points, and how far it sees in each direction.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::perception {

/// The end points of a scan, in order of bearing, and where it was taken; NaN for beams without information.
struct SeenPoints {
  Eigen::Vector2d from_map_m = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2f> points_map_m;
  std::vector<float> above_body_m;  ///< The height of each point.
};

/// How far a scan sees: degree by degree of the bearing in `map`, the shortest beam of each; without a beam: 0.
class SeenRanges {
 public:
  SeenRanges() { ranges_m_.fill(0.0); }
  explicit SeenRanges(const SeenPoints& seen);

  const Eigen::Vector2d& from_map_m() const { return from_map_m_; }
  /// In the direction of an offset from there.
  double range_m(const Eigen::Vector2d& offset_m) const;

 private:
  Eigen::Vector2d from_map_m_ = Eigen::Vector2d::Zero();
  std::array<double, 360> ranges_m_;
};

}  // namespace swiftlet::perception
