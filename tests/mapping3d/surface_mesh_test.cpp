// The surfaces of a voxel map as triangles.
#include "mapping3d/voxels/surface_mesh.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace swiftlet::mapping3d {
namespace {

using common::SurfaceMesh;
using common::SurfacePoint;
using common::VoxelMap;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kRadius_m = 0.6;

/// Occupied within a ball about (1, -2, 0.5), free around it in a cube, unknown beyond.
VoxelMap ball() {
  VoxelMap map(0.05);
  const Vector3d center_m(1.0, -2.0, 0.5);
  for (int z = -6; z < 26; ++z)
    for (int y = -56; y < -24; ++y)
      for (int x = 4; x < 36; ++x) {
        const double outside_m = (map.centerOf({x, y, z}) - center_m).norm() - kRadius_m;
        map.set({x, y, z}, static_cast<std::int8_t>(std::lround(std::clamp(-outside_m / 0.05, -1.0, 1.0) * 40.0)));
      }
  return map;
}

/// Enclosed by triangles that are counter-clockwise from outside (divergence theorem).
double volume_m3(const SurfaceMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&](std::uint32_t i) -> Vector3d { return mesh.vertices[i].position_m.cast<double>(); };
    sum += at(a).dot(at(b).cross(at(c)));
  }
  return sum / 6.0;
}

TEST(SurfaceMesh, ABallIsAClosedSurfaceSeenFromOutside) {
  const SurfaceMesh mesh = surfaceMesh(ball(), {});
  ASSERT_GT(mesh.triangles.size(), 1000u);
  for (const SurfaceMesh::Vertex& vertex : mesh.vertices)
    EXPECT_NEAR((vertex.position_m - Vector3f(1.0F, -2.0F, 0.5F)).norm(), kRadius_m, 0.015);
  const double sphere_m3 = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadius_m, 3);
  EXPECT_NEAR(volume_m3(mesh), sphere_m3, 0.03 * sphere_m3);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& [a, b, c] : mesh.triangles)
    for (const auto& edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) ++edges[edge];
  for (const auto& [edge, count] : edges)
    ASSERT_EQ(count, edges[std::pair(edge.second, edge.first)]) << "each side of a triangle has another on it";
}

TEST(SurfaceMesh, WhereNothingIsKnownThereIsNoSurface) {
  VoxelMap map(0.05);
  map.set({0, 0, 0}, 40);
  EXPECT_TRUE(surfaceMesh(map, {}).triangles.empty());
  map.set({1, 0, 0}, -20);
  EXPECT_EQ(surfaceMesh(map, {}).triangles.size(), 2u) << "one face of the voxel";
  EXPECT_TRUE(surfaceMesh(VoxelMap(0.05), {}).vertices.empty());
}

TEST(SurfaceMesh, PointsGiveItTheirPlaceAndColour) {
  VoxelMap map(0.05);
  std::vector<SurfacePoint> points;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) {
      map.set({x, y, 0}, 40);
      map.set({x, y, 1}, -40);
      for (const double dx_m : {0.012, 0.037})
        points.push_back(
            {Vector3d(0.05 * x + dx_m, 0.05 * y + 0.025, 0.031).cast<float>(), Vector3f::UnitZ(), {200, 40, 0}});
    }
  points.push_back({Vector3f::Constant(std::nanf("")), Vector3f::UnitZ(), {0, 0, 0}});
  const SurfaceMesh mesh = surfaceMesh(map, points);
  ASSERT_EQ(mesh.triangles.size(), 800u);
  for (const SurfaceMesh::Vertex& vertex : mesh.vertices) {
    EXPECT_NEAR(vertex.position_m.z(), 0.031, 1e-5) << "not 0.05, where the log odds change their sign";
    EXPECT_EQ(vertex.rgb, (std::array<std::uint8_t, 3>{200, 40, 0}));
  }
}

}  // namespace
}  // namespace swiftlet::mapping3d
