#include "simulation/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

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

using Segment = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

/// Adds the area between two heights y, in which no edge begins or ends: of the edges across it, sorted by x, every two
/// bound a trapezoid.
void addSlab(Triangles& mesh, const std::vector<Segment>& edges, double low_y_m, double high_y_m, double z_m) {
  std::vector<std::pair<double, double>> across;  // Of each edge the x in the middle and its index.
  const auto xAt = [](const Segment& edge, double y_m) {
    const Eigen::Vector2d along = edge.second - edge.first;
    return edge.first.x() + along.x() * (y_m - edge.first.y()) / along.y();
  };
  const double middle_y_m = 0.5 * (low_y_m + high_y_m);
  for (std::size_t i = 0; i < edges.size(); ++i)
    if ((edges[i].first.y() < middle_y_m) != (edges[i].second.y() < middle_y_m))
      across.emplace_back(xAt(edges[i], middle_y_m), static_cast<double>(i));
  std::sort(across.begin(), across.end());
  for (std::size_t i = 0; i + 1 < across.size(); i += 2) {
    const auto first = static_cast<Index>(mesh.vertices_m.size());
    const Segment &left = edges[static_cast<std::size_t>(across[i].second)],
                  &right = edges[static_cast<std::size_t>(across[i + 1].second)];
    for (const auto& [edge, y_m] :
         {std::pair{&left, low_y_m}, {&right, low_y_m}, {&right, high_y_m}, {&left, high_y_m}})
      mesh.vertices_m.push_back(Eigen::Vector3d(xAt(*edge, y_m), y_m, z_m).cast<float>());
    addQuad(mesh, first, first + 1, first + 2, first + 3);
  }
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

Triangles coneTriangles(double radius_m, double length_m) {
  Triangles mesh;
  addRing(mesh, radius_m, -0.5 * length_m, false);
  addCap(mesh, 0, -0.5 * length_m);
  addCap(mesh, 0, 0.5 * length_m);
  return mesh;
}

Triangles prismTriangles(const std::vector<std::vector<Eigen::Vector2d>>& outlines_m, double height_m) {
  Triangles mesh;
  std::vector<Segment> edges;
  std::vector<double> slabs_y_m;
  for (const auto& outline : outlines_m)
    for (std::size_t i = 0; i < outline.size(); ++i) {
      edges.emplace_back(outline[i], outline[(i + 1) % outline.size()]);
      slabs_y_m.push_back(outline[i].y());
    }
  for (const auto& [from, to] : edges) {
    const auto first = static_cast<Index>(mesh.vertices_m.size());
    for (const double z_m : {0.0, height_m})
      for (const Eigen::Vector2d& point : {from, to})
        mesh.vertices_m.push_back(Eigen::Vector3d(point.x(), point.y(), z_m).cast<float>());
    addQuad(mesh, first, first + 1, first + 3, first + 2);
  }
  std::sort(slabs_y_m.begin(), slabs_y_m.end());
  for (std::size_t i = 0; i + 1 < slabs_y_m.size(); ++i)
    for (const double z_m : {0.0, height_m})
      if (slabs_y_m[i] < slabs_y_m[i + 1]) addSlab(mesh, edges, slabs_y_m[i], slabs_y_m[i + 1], z_m);
  return mesh;
}

Triangles terrainTriangles(const std::vector<double>& heights_m, std::size_t columns, const Eigen::Vector2d& size_m) {
  Triangles mesh;
  const std::size_t rows = heights_m.size() / columns;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const double x = static_cast<double>(column) / static_cast<double>(columns - 1) - 0.5;
      const double y = 0.5 - static_cast<double>(row) / static_cast<double>(rows - 1);
      mesh.vertices_m.push_back(
          Eigen::Vector3d(x * size_m.x(), y * size_m.y(), heights_m[row * columns + column]).cast<float>());
      if (row == 0 || column == 0) continue;
      const auto last = static_cast<Index>(row * columns + column), above = last - static_cast<Index>(columns);
      addQuad(mesh, above - 1, above, last, last - 1);
    }
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
