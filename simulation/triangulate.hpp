// Solids as triangles, each about its own origin. Curved ones have sides of at most 6 degrees, with the corners on the
// true surface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::simulation {

struct Triangles {
  std::vector<Eigen::Vector3f> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> indices;
};

inline constexpr int kSidesOfCircle = 60;

Triangles boxTriangles(const Eigen::Vector3d& size_m);
/// Upright along z.
Triangles cylinderTriangles(double radius_m, double length_m);
/// A cylinder with half spheres at its ends; length 0 is a sphere. `scale` stretches it to an ellipsoid.
Triangles capsuleTriangles(double radius_m, double length_m, const Eigen::Vector3d& scale = Eigen::Vector3d::Ones());
/// A rectangle across `normal`, in tiles, so that single-precision rays stay exact on a large one.
Triangles planeTriangles(const Eigen::Vector3d& normal, const Eigen::Vector2d& size_m);

}  // namespace swiftlet::simulation
