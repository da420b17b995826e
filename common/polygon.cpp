#include "common/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/segment.hpp"

namespace swiftlet::common {
namespace {

using Point = Eigen::Vector2d;

/// Less area is a mistake: a hull is larger.
constexpr double kLeastArea_m2 = 0.01;

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

bool touch(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double at_c = cross(b - a, c - a), at_d = cross(b - a, d - a);
  const double at_a = cross(d - c, a - c), at_b = cross(d - c, b - c);
  if (((at_c > 0) != (at_d > 0)) && ((at_a > 0) != (at_b > 0))) return true;
  constexpr double kSame_m = 1e-9;
  return std::min({segmentDistance(c, a, b), segmentDistance(d, a, b), segmentDistance(a, c, d),
                   segmentDistance(b, c, d)}) < kSame_m;
}

bool crossesItself(const std::vector<Point>& corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j)
      if ((j + 1) % n != i && touch(corners[i], corners[i + 1], corners[j], corners[(j + 1) % n])) return true;
  return false;
}

double signedArea_m2(const std::vector<Point>& corners) {
  double twice = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) twice += cross(corners[i], corners[(i + 1) % corners.size()]);
  return 0.5 * twice;
}

}  // namespace

bool Polygon::contains(const Point& point_map_m) const {
  bool inside = false;
  for (std::size_t i = 0, j = corners_map_m.size() - 1; i < corners_map_m.size(); j = i++) {
    const Point &a = corners_map_m[i], &b = corners_map_m[j];
    if ((a.y() > point_map_m.y()) == (b.y() > point_map_m.y())) continue;
    if (point_map_m.x() < a.x() + (b.x() - a.x()) * (point_map_m.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

double Polygon::edgeDistance_m(const Point& point_map_m) const {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners_map_m.size(); ++i)
    nearest_m = std::min(nearest_m,
                         segmentDistance(point_map_m, corners_map_m[i], corners_map_m[(i + 1) % corners_map_m.size()]));
  return nearest_m;
}

double Polygon::signedDistance_m(const Point& point_map_m) const {
  return contains(point_map_m) ? -edgeDistance_m(point_map_m) : edgeDistance_m(point_map_m);
}

Point Polygon::min_map_m() const {
  Point least = corners_map_m.front();
  for (const Point& corner : corners_map_m) least = least.cwiseMin(corner);
  return least;
}

Point Polygon::max_map_m() const {
  Point greatest = corners_map_m.front();
  for (const Point& corner : corners_map_m) greatest = greatest.cwiseMax(corner);
  return greatest;
}

double Polygon::area_m2() const { return std::abs(signedArea_m2(corners_map_m)); }

std::optional<Message> problemOf(const Polygon& polygon) {
  const std::vector<Point>& corners = polygon.corners_map_m;
  if (corners.size() < 3)
    return Message("polygon.too-few-corners", "a polygon has at least 3 corners, not {}", corners.size());
  if (corners.size() > kMostCorners)
    return Message("polygon.too-many-corners", "a polygon has at most {} corners, not {}", kMostCorners,
                   corners.size());
  for (const Point& corner : corners)
    if (!corner.allFinite() || corner.cwiseAbs().maxCoeff() > kGreatestCoordinate_m)
      return Message("polygon.no-point", "a corner is not a point of the map");
  if (crossesItself(corners)) return Message("polygon.edges-cross", "edges of the polygon cross");
  if (polygon.area_m2() < kLeastArea_m2)
    return Message("polygon.no-area", "the polygon has an area of {:.3f} m2", polygon.area_m2());
  return std::nullopt;
}

std::string toString(const Polygon& polygon, const PlaceNames& names) {
  Point sum = Point::Zero();
  for (const Point& corner : polygon.corners_map_m) sum += corner;
  const Point middle = sum / static_cast<double>(std::max<std::size_t>(1, polygon.corners_map_m.size()));
  return fmt::format("{} corners about {}", polygon.corners_map_m.size(), names.of(middle));
}

}  // namespace swiftlet::common
