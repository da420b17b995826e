#include "simulation/triangulate.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace swiftlet::simulation {
namespace {

using Index = std::uint32_t;

Eigen::Vector2d onCircle(int side) {
  const double angle_rad = 2.0 * std::numbers::pi * side / kSidesOfCircle;
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

void addQuad(Triangles& mesh, Index a, Index b, Index c, Index d) {
  mesh.indices.push_back({a, b, c});
  mesh.indices.push_back({a, c, d});
}

/// Adds a ring of kSidesOfCircle vertices and joins it to the ring before it, if there is one.
void addRing(Triangles& mesh, double radius_m, double z_m, bool join) {
  const auto first = static_cast<Index>(mesh.vertices_m.size());
  for (int side = 0; side < kSidesOfCircle; ++side) {
    const Eigen::Vector2d point = radius_m * onCircle(side);
    mesh.vertices_m.push_back(Eigen::Vector3d(point.x(), point.y(), z_m).cast<float>());
  }
  if (!join) return;
  const Index below = first - kSidesOfCircle;
  for (Index side = 0; side < kSidesOfCircle; ++side) {
    const Index next = (side + 1) % kSidesOfCircle;
    addQuad(mesh, below + side, below + next, first + next, first + side);
  }
}

void addCap(Triangles& mesh, Index ring, double z_m) {
  const auto centre = static_cast<Index>(mesh.vertices_m.size());
  mesh.vertices_m.emplace_back(0.0F, 0.0F, static_cast<float>(z_m));
  for (Index side = 0; side < kSidesOfCircle; ++side)
    mesh.indices.push_back({centre, ring + side, ring + (side + 1) % kSidesOfCircle});
}

}  // namespace

Triangles boxTriangles(const Eigen::Vector3d& size_m) {
  Triangles mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d sign((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                               (corner & 4) != 0 ? 0.5 : -0.5);
    mesh.vertices_m.push_back(size_m.cwiseProduct(sign).cast<float>());
  }
  addQuad(mesh, 0, 2, 3, 1);
  addQuad(mesh, 4, 5, 7, 6);
  addQuad(mesh, 0, 1, 5, 4);
  addQuad(mesh, 2, 6, 7, 3);
  addQuad(mesh, 0, 4, 6, 2);
  addQuad(mesh, 1, 3, 7, 5);
  return mesh;
}

Triangles cylinderTriangles(double radius_m, double length_m) {
  Triangles mesh;
  addRing(mesh, radius_m, -0.5 * length_m, false);
  addRing(mesh, radius_m, 0.5 * length_m, true);
  addCap(mesh, 0, -0.5 * length_m);
  addCap(mesh, kSidesOfCircle, 0.5 * length_m);
  return mesh;
}

Triangles capsuleTriangles(double radius_m, double length_m, const Eigen::Vector3d& scale) {
  Triangles mesh;
  constexpr int kRings = kSidesOfCircle / 4;  // From a pole to the equator.
  for (int ring = 1; ring <= kRings; ++ring) {
    const double latitude_rad = -0.5 * std::numbers::pi * (1.0 - static_cast<double>(ring) / kRings);
    addRing(mesh, radius_m * std::cos(latitude_rad), radius_m * std::sin(latitude_rad) - 0.5 * length_m, ring > 1);
  }
  for (int ring = length_m > 0.0 ? 0 : 1; ring < kRings; ++ring) {
    const double latitude_rad = 0.5 * std::numbers::pi * ring / kRings;
    addRing(mesh, radius_m * std::cos(latitude_rad), radius_m * std::sin(latitude_rad) + 0.5 * length_m, true);
  }
  const auto last_ring = static_cast<Index>(mesh.vertices_m.size()) - kSidesOfCircle;
  addCap(mesh, 0, -0.5 * length_m - radius_m);
  addCap(mesh, last_ring, 0.5 * length_m + radius_m);
  for (Eigen::Vector3f& vertex : mesh.vertices_m) vertex = vertex.cwiseProduct(scale.cast<float>());
  return mesh;
}

Triangles planeTriangles(const Eigen::Vector3d& normal, const Eigen::Vector2d& size_m) {
  Triangles mesh;
  const Eigen::Quaterniond rotation = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal);
  constexpr Index kTiles = 8;
  for (Index row = 0; row <= kTiles; ++row) {
    for (Index column = 0; column <= kTiles; ++column) {
      const Eigen::Vector3d point((static_cast<double>(column) / kTiles - 0.5) * size_m.x(),
                                  (static_cast<double>(row) / kTiles - 0.5) * size_m.y(), 0.0);
      mesh.vertices_m.push_back((rotation * point).cast<float>());
      if (row == 0 || column == 0) continue;
      const Index last = row * (kTiles + 1) + column;
      addQuad(mesh, last - kTiles - 2, last - kTiles - 1, last, last - 1);
    }
  }
  return mesh;
}

}  // namespace swiftlet::simulation
