// Points of surfaces, thinned: one for each cube, the mean of all that fell into it.
#pragma once

#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/submap3d.hpp"
#include "mapping3d/model/surface_points.hpp"

namespace swiftlet::mapping3d {

/// Points of a grid with the weights by which their means continue.
struct WeightedPoints {
  std::shared_ptr<const std::vector<common::SurfacePoint>> points;  ///< Never null.
  std::vector<float> weights;                                       ///< One for each point.
};

/// One thread. The same points in the same order give the same bits.
class PointGrid {
 public:
  explicit PointGrid(double cube_m) : cube_m_(cube_m) {}

  void add(std::span<const SeenPoint> points, const common::Pose3& T_submap_camera);
  /// Points of another grid again, with the weights that they had in it.
  void add(const WeightedPoints& points);

  /// In the order in which their cubes were first seen.
  std::vector<common::SurfacePoint> points() const;
  WeightedPoints weightedPoints() const;

 private:
  struct Sums {
    Eigen::Vector3f position_m = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    Eigen::Vector3f rgb = Eigen::Vector3f::Zero();
    float weight = 0.0F;
  };
  void add(const Eigen::Vector3f& position_m, const Eigen::Vector3f& normal, const std::array<std::uint8_t, 3>& rgb,
           float weight);

  double cube_m_;
  std::unordered_map<std::uint64_t, std::uint32_t> cubes_;  ///< The index into sums_ of a cube.
  std::vector<Sums> sums_;
};

/// The points reduced to one for each cube of that size.
WeightedPoints thinned(const WeightedPoints& points, double cube_m);

}  // namespace swiftlet::mapping3d
