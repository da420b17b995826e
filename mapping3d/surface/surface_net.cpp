#include "mapping3d/surface/surface_net.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <utility>

#include "common/submap3d.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::SurfaceMesh;
using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;
using Eigen::Vector3f;

/// Along the view the distance grows by a voxel a voxel, across a surface seen at 75 degrees by this many. That is the
/// greatest slope of depth_between.cpp.
constexpr float kSteepestVoxels = 4.0F;
/// And by the errors of both means, in standard deviations.
constexpr float kErrorSigmas = 2.0F;

VoxelIndex stepped(VoxelIndex voxel, int axis, int by) {
  (axis == 0 ? voxel.x : axis == 1 ? voxel.y : voxel.z) += by;
  return voxel;
}

/// The voxels of a block and of the seven beyond it, by their place from its first voxel.
class BlockCorner {
 public:
  BlockCorner(const TsdfVolume& volume, VoxelIndex block) {
    for (int i = 0; i < 8; ++i)
      blocks_[static_cast<std::size_t>(i)] =
          volume.block({block.x + (i & 1), block.y + (i >> 1 & 1), block.z + (i >> 2)});
  }

  /// Each coordinate is at least 0 and less than two blocks. Null where nothing was seen.
  const TsdfVoxel* at(VoxelIndex place) const {
    const int in = (place.x >> VoxelBlock::kSideBits) | (place.y >> VoxelBlock::kSideBits) << 1 |
                   (place.z >> VoxelBlock::kSideBits) << 2;
    const TsdfBlock* block = blocks_[static_cast<std::size_t>(in)];
    if (block == nullptr) return nullptr;
    const TsdfVoxel& voxel = block->voxels[static_cast<std::size_t>(VoxelBlock::offsetOf(place))];
    return voxel.weight_1_m2 > 0.0F ? &voxel : nullptr;
  }

 private:
  std::array<const TsdfBlock*, 8> blocks_;
};

/// Where the surface crosses the edges of a cube.
struct Crossings {
  Vector3f place_voxels = Vector3f::Zero();  ///< Sum, from the centre of the first voxel of the block.
  Vector3f rgb = Vector3f::Zero();           ///< Sum, of those with a colour.
  float count = 0.0F, colored = 0.0F;
};

class TsdfNet {
 public:
  explicit TsdfNet(const TsdfVolume& volume) : volume_(volume), voxel_m_(static_cast<float>(volume.resolution_m())) {}

  SurfaceMesh mesh() && {
    const std::vector<VoxelIndex> blocks = volume_.blocks();
    for (const VoxelIndex& block : blocks) addVertices(block);
    for (const VoxelIndex& block : blocks) addFaces(block);
    return std::move(mesh_);
  }

 private:
  /// Where the distance is zero between two voxels, as a share of the way; none if the surface does not cross there.
  std::optional<float> crossing(const TsdfVoxel* from, const TsdfVoxel* to) const {
    if (from == nullptr || to == nullptr) return std::nullopt;
    const float at_from = from->distance_m, at_to = to->distance_m;
    if ((at_from < 0.0F) == (at_to < 0.0F)) return std::nullopt;
    const float error_m = 1.0F / std::sqrt(from->weight_1_m2) + 1.0F / std::sqrt(to->weight_1_m2);
    if (std::abs(at_from - at_to) > kSteepestVoxels * voxel_m_ + kErrorSigmas * error_m) return std::nullopt;
    return at_from / (at_from - at_to);
  }

  void addVertices(VoxelIndex block) {
    const BlockCorner corner(volume_, block);
    for (int offset = 0; offset < VoxelBlock::kVoxels; ++offset) {
      const VoxelIndex cube = VoxelMap::voxelOf({}, offset);
      const Crossings crossings = crossingsIn(corner, cube);
      if (crossings.count == 0.0F) continue;
      vertices_.emplace(VoxelMap::voxelOf(block, offset), static_cast<std::uint32_t>(mesh_.vertices.size()));
      mesh_.vertices.push_back(vertexOf(VoxelMap::firstOf(block), crossings));
    }
  }

  Crossings crossingsIn(const BlockCorner& corner, VoxelIndex cube) const {
    std::array<const TsdfVoxel*, 8> voxels{};
    std::array<VoxelIndex, 8> places{};
    int behind = 0;
    for (int i = 0; i < 8; ++i) {
      const auto at = static_cast<std::size_t>(i);
      places[at] = {cube.x + (i & 1), cube.y + (i >> 1 & 1), cube.z + (i >> 2)};
      voxels[at] = corner.at(places[at]);
      if (voxels[at] == nullptr) return {};
      behind += voxels[at]->distance_m < 0.0F ? 1 : 0;
    }
    Crossings crossings;
    if (behind == 0 || behind == 8) return crossings;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t from = 0; from < 8; ++from) {
        const std::size_t to = from | std::size_t{1} << axis;
        if (to != from) add(voxels[from], voxels[to], places[from], static_cast<int>(axis), crossings);
      }
    return crossings;
  }

  void add(const TsdfVoxel* from, const TsdfVoxel* to, VoxelIndex place, int axis, Crossings& crossings) const {
    const std::optional<float> share = crossing(from, to);
    if (!share) return;
    crossings.place_voxels +=
        Vector3f(static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.z)) +
        *share * Vector3f::Unit(axis);
    ++crossings.count;
    for (const TsdfVoxel* voxel : {from, to}) {
      if (!voxel->has_color) continue;
      const float weight = voxel == from ? 1.0F - *share : *share;
      for (int i = 0; i < 3; ++i)
        crossings.rgb[i] += weight * static_cast<float>(voxel->rgb[static_cast<std::size_t>(i)]);
      crossings.colored += weight;
    }
  }

  SurfaceMesh::Vertex vertexOf(VoxelIndex first, const Crossings& crossings) const {
    const Eigen::Vector3d place = (crossings.place_voxels / crossings.count).cast<double>();
    SurfaceMesh::Vertex vertex{
        ((Eigen::Vector3d(first.x + 0.5, first.y + 0.5, first.z + 0.5) + place) * volume_.resolution_m()).cast<float>(),
        common::kUnknownColor};
    if (crossings.colored > 0.0F)
      for (int i = 0; i < 3; ++i)
        vertex.rgb[static_cast<std::size_t>(i)] =
            static_cast<std::uint8_t>(std::lround(crossings.rgb[i] / crossings.colored));
    return vertex;
  }

  /// Each edge that the surface crosses has a face, whose corners are the vertices of the four cubes around it.
  void addFaces(VoxelIndex block) {
    const BlockCorner corner(volume_, block);
    for (int offset = 0; offset < VoxelBlock::kVoxels; ++offset) {
      const VoxelIndex place = VoxelMap::voxelOf({}, offset);
      const TsdfVoxel* from = corner.at(place);
      if (from == nullptr) continue;
      for (int axis = 0; axis < 3; ++axis)
        if (crossing(from, corner.at(stepped(place, axis, 1))))
          addFace(VoxelMap::voxelOf(block, offset), axis, from->distance_m < 0.0F);
    }
  }

  void addFace(VoxelIndex voxel, int axis, bool seen_along_axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const std::array<VoxelIndex, 4> cubes{stepped(stepped(voxel, u, -1), v, -1), stepped(voxel, v, -1), voxel,
                                          stepped(voxel, u, -1)};
    std::array<std::uint32_t, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto found = vertices_.find(cubes[i]);
      if (found == vertices_.end()) return;
      corners[i] = found->second;
    }
    if (!seen_along_axis) std::swap(corners[1], corners[3]);
    addTriangles(corners);
  }

  /// Divided along the shorter diagonal.
  void addTriangles(const std::array<std::uint32_t, 4>& corners) {
    const auto& [a, b, c, d] = corners;
    const auto apart = [&](std::uint32_t from, std::uint32_t to) {
      return (mesh_.vertices[from].position_m - mesh_.vertices[to].position_m).squaredNorm();
    };
    if (apart(a, c) <= apart(b, d)) {
      mesh_.triangles.push_back({a, b, c});
      mesh_.triangles.push_back({a, c, d});
    } else {
      mesh_.triangles.push_back({a, b, d});
      mesh_.triangles.push_back({b, c, d});
    }
  }

  const TsdfVolume& volume_;
  float voxel_m_;
  std::unordered_map<VoxelIndex, std::uint32_t, VoxelMap::Hash> vertices_;  ///< By the least corner of their cube.
  SurfaceMesh mesh_;
};

}  // namespace

SurfaceMesh surfaceNet(const TsdfVolume& volume) { return TsdfNet(volume).mesh(); }

}  // namespace swiftlet::mapping3d
