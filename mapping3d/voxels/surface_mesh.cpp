#include "mapping3d/voxels/surface_mesh.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <unordered_map>

namespace swiftlet::mapping3d {
namespace {

using common::SurfaceMesh;
using common::SurfacePoint;
using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;
using Eigen::Vector3d;
using Eigen::Vector3f;

VoxelIndex moved(VoxelIndex voxel, int axis, int by) {
  (axis == 0 ? voxel.x : axis == 1 ? voxel.y : voxel.z) += by;
  return voxel;
}

/// Means of the points in cubes of the size of a voxel.
class ColouredPoints {
 public:
  ColouredPoints(std::span<const SurfacePoint> points, double cube_m) : grid_(cube_m) {
    for (const SurfacePoint& point : points) {
      if (!point.position_m.allFinite()) continue;
      Sum& sum = sums_[grid_.voxelAt(point.position_m.cast<double>())];
      sum.position_m += point.position_m;
      for (int i = 0; i < 3; ++i) sum.rgb[i] += static_cast<float>(point.rgb[static_cast<std::size_t>(i)]);
      ++sum.count;
    }
  }

  /// The vertex at the mean of the points within half a cube of it along each axis, about, and with their colour.
  SurfaceMesh::Vertex vertexAt(const Vector3d& position_m) const {
    const double half_m = 0.5 * grid_.resolution_m();
    const VoxelIndex low = grid_.voxelAt(position_m - Vector3d::Constant(half_m));
    Sum all;
    for (int z = 0; z <= 1; ++z)
      for (int y = 0; y <= 1; ++y)
        for (int x = 0; x <= 1; ++x)
          if (const auto sum = sums_.find({low.x + x, low.y + y, low.z + z}); sum != sums_.end()) all += sum->second;
    if (all.count == 0.0F) return {position_m.cast<float>(), common::kUnknownColor};
    const Vector3f rgb = all.rgb / all.count;
    SurfaceMesh::Vertex vertex{all.position_m / all.count, {}};
    for (int i = 0; i < 3; ++i)
      vertex.rgb[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(rgb[i]));
    return vertex;
  }

 private:
  struct Sum {
    Vector3f position_m = Vector3f::Zero(), rgb = Vector3f::Zero();
    float count = 0.0F;

    Sum& operator+=(const Sum& other) {
      position_m += other.position_m;
      rgb += other.rgb;
      count += other.count;
      return *this;
    }
  };
  VoxelMap grid_;  ///< Empty: it only numbers the cubes.
  std::unordered_map<VoxelIndex, Sum, VoxelMap::Hash> sums_;
};

class SurfaceNet {
 public:
  SurfaceNet(const VoxelMap& map, std::span<const SurfacePoint> points)
      : map_(map), points_(points, map.resolution_m()) {}

  SurfaceMesh mesh() && {
    for (const VoxelIndex& block : map_.blocks()) {
      const VoxelBlock& content = *map_.block(block);
      for (int offset = 0; offset < VoxelBlock::kVoxels; ++offset)
        if (content.evidence[static_cast<std::size_t>(offset)] > 0) addFaces(VoxelMap::voxelOf(block, offset));
    }
    return std::move(mesh_);
  }

 private:
  /// Between an occupied voxel and each free one beside it there is a face, whose corners are the vertices of the four
  /// cubes around the edge from centre to centre.
  void addFaces(VoxelIndex occupied) {
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        if (!map_.isFree(moved(occupied, axis, step))) continue;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const VoxelIndex low = step < 0 ? moved(occupied, axis, -1) : occupied;
        const std::uint32_t a = vertexOf(moved(moved(low, u, -1), v, -1)), b = vertexOf(moved(low, v, -1)),
                            c = vertexOf(low), d = vertexOf(moved(low, u, -1));
        addTriangles(step > 0 ? std::array{a, b, c, d} : std::array{a, d, c, b});
      }
  }

  void addTriangles(const std::array<std::uint32_t, 4>& corners) {
    mesh_.triangles.push_back({corners[0], corners[1], corners[2]});
    mesh_.triangles.push_back({corners[0], corners[2], corners[3]});
  }

  std::uint32_t vertexOf(VoxelIndex cube) {
    const auto [entry, added] = vertices_.try_emplace(cube, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (added) mesh_.vertices.push_back(points_.vertexAt(crossingIn(cube)));
    return entry->second;
  }

  /// The mean of where the log odds change their sign on the edges of the cube of eight voxel centres.
  Vector3d crossingIn(VoxelIndex cube) const {
    Vector3d sum_m = Vector3d::Zero();
    int count = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (int corner = 0; corner < 4; ++corner) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const VoxelIndex from = moved(moved(cube, u, corner & 1), v, corner >> 1), to = moved(from, axis, 1);
        if (!map_.isKnown(from) || !map_.isKnown(to) || map_.isOccupied(from) == map_.isOccupied(to)) continue;
        const double at_from = map_.evidence(from), at_to = map_.evidence(to);
        const double share = at_from / (at_from - at_to);
        sum_m += map_.centerOf(from) + share * (map_.centerOf(to) - map_.centerOf(from));
        ++count;
      }
    return sum_m / count;
  }

  const VoxelMap& map_;
  ColouredPoints points_;
  std::unordered_map<VoxelIndex, std::uint32_t, VoxelMap::Hash> vertices_;  ///< By the least corner of their cube.
  SurfaceMesh mesh_;
};

}  // namespace

SurfaceMesh surfaceMesh(const VoxelMap& map, std::span<const SurfacePoint> points) {
  return SurfaceNet(map, points).mesh();
}

}  // namespace swiftlet::mapping3d
