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
/// Upright along z, its tip above.
Triangles coneTriangles(double radius_m, double length_m);
/// The area within the outlines, of which every second one around a point is a hole, from z = 0 up to `height_m`. Each
/// outline is closed from its last point to its first.
Triangles prismTriangles(const std::vector<std::vector<Eigen::Vector2d>>& outlines_m, double height_m);
/// A grid of heights over a rectangle about the origin: the first row is at the greatest y, the first column at the
/// least x. Two rows and two columns or more.
Triangles terrainTriangles(const std::vector<double>& heights_m, std::size_t columns, const Eigen::Vector2d& size_m);
/// A rectangle across `normal`, in tiles, so that single-precision rays stay exact on a large one.
Triangles planeTriangles(const Eigen::Vector3d& normal, const Eigen::Vector2d& size_m);

}  // namespace swiftlet::simulation
