#include "simulation/nearest_point.hpp"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

namespace swiftlet::simulation {
namespace {

Eigen::Vector3d nearestOnSegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& point) {
  const Eigen::Vector3d along = b - a;
  const double squared = along.squaredNorm();
  if (squared <= 0.0) return a;
  return a + std::clamp(along.dot(point - a) / squared, 0.0, 1.0) * along;
}

/// Whether a point in the triangle's plane is inside of it, which is so if it is on the same side of all edges.
bool isInside(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& normal,
              const Eigen::Vector3d& point) {
  for (std::size_t i = 0; i < 3; ++i)
    if ((corners[(i + 1) % 3] - corners[i]).cross(point - corners[i]).dot(normal) < 0.0) return false;
  return true;
}

}  // namespace

Eigen::Vector3d nearestPoint(const std::array<Eigen::Vector3d, 3>& triangle_m, const Eigen::Vector3d& point_m) {
  const Eigen::Vector3d normal = (triangle_m[1] - triangle_m[0]).cross(triangle_m[2] - triangle_m[0]);
  if (const double squared = normal.squaredNorm(); squared > 0.0) {
    Eigen::Vector3d projected = point_m - normal * (normal.dot(point_m - triangle_m[0]) / squared);
    if (isInside(triangle_m, normal, projected)) return projected;
  }
  Eigen::Vector3d nearest = triangle_m[0];
  double least_m2 = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d on_edge = nearestOnSegment(triangle_m[i], triangle_m[(i + 1) % 3], point_m);
    const double distance_m2 = (on_edge - point_m).squaredNorm();
    if (distance_m2 >= least_m2) continue;
    least_m2 = distance_m2;
    nearest = on_edge;
  }
  return nearest;
}

}  // namespace swiftlet::simulation
