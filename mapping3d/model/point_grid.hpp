// Points of surfaces, thinned: one for each cube, the mean of all that fell into it.
//
// Where the noise of points is greater than a cube, they would fill the cubes in front of their surface and behind it:
// they are averaged in larger cubes, and only where nothing better was seen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <unordered_set>
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
  std::size_t fine = 0;                                             ///< Points of small cubes; the others follow.
};

/// One thread. The same points in the same order give the same bits.
class PointGrid {
 public:
  explicit PointGrid(double cube_m);

  void add(std::span<const SeenPoint> points, const common::Pose3& T_submap_camera);
  /// Points of another grid again, with the weights that they had in it.
  void add(const WeightedPoints& points);

  /// In the order in which their cubes were first seen.
  WeightedPoints points() const;

 private:
  using Key = std::uint64_t;

  struct Sums {
    Eigen::Vector3f position_m = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    Eigen::Vector3f rgb = Eigen::Vector3f::Zero();
    float weight = 0.0F;

    common::SurfacePoint mean() const;
  };
  struct Cubes {
    double side_m = 0.0;
    std::unordered_map<Key, std::uint32_t> index = {};  ///< Into `sums`, of a cube.
    std::vector<Sums> sums = {};

    Key keyOf(const Eigen::Vector3f& position_m) const;
    /// Whether it is the first in its cube.
    bool add(const common::SurfacePoint& point, float weight);
  };
  void addFine(const common::SurfacePoint& point, float weight);
  bool sawBetter(const Sums& sums) const;

  Cubes fine_, coarse_;
  std::unordered_set<Key> seen_well_;  ///< Large cubes in which a small one has a point.
};

/// The points reduced to one for each cube of that size.
WeightedPoints thinned(const WeightedPoints& points, double cube_m);

}  // namespace swiftlet::mapping3d
