// A polygon in the plane of the map: a keep-out zone, or an area to survey.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/message.hpp"
#include "common/place_names.hpp"

namespace swiftlet::common {

/// In the `map` frame, the corners in order, in either direction. Valid if problemOf() finds nothing.
struct Polygon {
  std::vector<Eigen::Vector2d> corners_map_m;

  bool operator==(const Polygon&) const = default;

  bool contains(const Eigen::Vector2d& point_map_m) const;
  /// From the edge, whether the point is inside or outside.
  double edgeDistance_m(const Eigen::Vector2d& point_map_m) const;
  /// From the edge: positive outside, negative inside.
  double signedDistance_m(const Eigen::Vector2d& point_map_m) const;
  Eigen::Vector2d min_map_m() const;
  Eigen::Vector2d max_map_m() const;
  double area_m2() const;
};

inline constexpr std::size_t kMostCorners = 64;
/// No map is this large: points farther from the origin are mistakes.
inline constexpr double kGreatestCoordinate_m = 1e5;

/// Why it is no polygon: too few or too many corners, one that is not a point of a map, edges that cross, no area.
/// nullopt if it is sound.
std::optional<Message> problemOf(const Polygon& polygon);
/// "4 corners about (1.00, 2.00)".
std::string toString(const Polygon& polygon, const PlaceNames& names = {});

}  // namespace swiftlet::common
