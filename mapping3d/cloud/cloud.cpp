#include "mapping3d/cloud/cloud.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <unordered_set>
#include <utility>

#include <pcl/common/centroid.h>
#include <pcl/common/eigen.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include "mapping3d/cloud/large_cubes.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::SurfacePoint;
using Eigen::Vector3f;
using PclPoint = pcl::PointXYZRGBNormal;
using PclCloud = pcl::PointCloud<PclPoint>;

/// PCL counts the cubes of a box in 31 bits, so it is given tiles of this many cubes in each direction.
constexpr std::int64_t kTileCubes = 1024;
/// Farther points are errors: no building is 100 km wide. It also keeps the numbers of the cubes in range.
constexpr float kFarthest_m = 1e5F;
/// A plane has three points; more make its direction certain.
constexpr int kPlaneNeighbours = 10;
/// Cubes that must grow do so by at least this factor, so that it does not take many trials.
constexpr double kLeastGrowth = 1.1;
/// A noisy point has this many large cubes with points around it, up to kAroundCubes away. At the end of a row of them
/// it has two; errors seldom lie three together.
constexpr int kFewestAround = 2;
constexpr int kAroundCubes = 2;

PclPoint pclPoint(const SurfacePoint& point) {
  PclPoint result;
  result.getVector3fMap() = point.position_m;
  result.getNormalVector3fMap() = point.normal;
  std::tie(result.r, result.g, result.b) = std::tie(point.rgb[0], point.rgb[1], point.rgb[2]);
  return result;
}

SurfacePoint surfacePoint(const PclPoint& point) {
  return {point.getVector3fMap(), point.getNormalVector3fMap(), {point.r, point.g, point.b}};
}

bool isKnown(const Vector3f& normal) { return normal.squaredNorm() > 0.5F; }

/// Points with their pose in the cloud. A list of all points of a large map would take as much memory as the map.
struct Piece {
  std::span<const SurfacePoint> points;
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  Vector3f origin_m = Vector3f::Zero();

  SurfacePoint at(std::size_t index) const {
    const SurfacePoint& point = points[index];
    return {rotation * point.position_m + origin_m, rotation * point.normal, point.rgb};
  }
};
using TileIndex = std::array<std::int64_t, 3>;

std::optional<TileIndex> tileOf(const SurfacePoint& point, float cube_m) {
  const float per_m = 1.0F / cube_m;  // As PCL computes a cube's number.
  if (!point.position_m.allFinite() || !point.normal.allFinite()) return std::nullopt;
  if (point.position_m.cwiseAbs().maxCoeff() > kFarthest_m) return std::nullopt;
  TileIndex tile{};
  for (int axis = 0; axis < 3; ++axis)
    tile[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(
        std::floor(std::floor(point.position_m[axis] * per_m) / static_cast<float>(kTileCubes)));
  return tile;
}

/// What of a piece lies in a tile.
struct Share {
  const Piece* piece;
  std::size_t points;
};

/// Tiles whose borders are borders of cubes, each with what lies in it.
std::map<TileIndex, std::vector<Share>> tilesOf(const std::vector<Piece>& pieces, float cube_m) {
  std::map<TileIndex, std::vector<Share>> tiles;
  for (const Piece& piece : pieces)
    for (std::size_t i = 0; i < piece.points.size(); ++i) {
      const auto tile = tileOf(piece.at(i), cube_m);
      if (!tile) continue;
      std::vector<Share>& shares = tiles[*tile];
      if (shares.empty() || shares.back().piece != &piece) shares.push_back({&piece, 0});
      ++shares.back().points;
    }
  return tiles;
}

PclCloud::Ptr cloudOf(const TileIndex& tile, const std::vector<Share>& shares, float cube_m) {
  std::size_t size = 0;
  for (const Share& share : shares) size += share.points;
  auto cloud = pcl::make_shared<PclCloud>();
  cloud->reserve(size);
  for (const Share& share : shares)
    for (std::size_t i = 0; i < share.piece->points.size(); ++i) {
      const SurfacePoint point = share.piece->at(i);
      if (tileOf(point, cube_m) == tile) cloud->push_back(pclPoint(point));
    }
  return cloud;
}

/// Opposite normals of a thin wall may cancel each other: the point has none then.
void clearUnknownNormals(PclCloud& cloud) {
  for (PclPoint& point : cloud)
    if (!point.getNormalVector3fMap().allFinite() || !isKnown(point.getNormalVector3fMap()))
      point.getNormalVector3fMap().setZero();
}

std::size_t sizeOf(const std::vector<Piece>& pieces) {
  std::size_t size = 0;
  for (const Piece& piece : pieces) size += piece.points.size();
  return size;
}

/// One point a cube, made tile by tile: PCL's points take twice the memory of the map's.
std::vector<SurfacePoint> thinned(const std::vector<Piece>& pieces, float cube_m) {
  std::vector<SurfacePoint> all;
  all.reserve(sizeOf(pieces));  // The unused part is never touched, so that it takes no memory.
  for (const auto& [tile, shares] : tilesOf(pieces, cube_m)) {
    pcl::VoxelGrid<PclPoint> grid;
    grid.setLeafSize(cube_m, cube_m, cube_m);
    grid.setDownsampleAllData(true);
    grid.setInputCloud(cloudOf(tile, shares, cube_m));
    PclCloud kept;
    grid.filter(kept);
    clearUnknownNormals(kept);
    for (const PclPoint& point : kept) all.push_back(surfacePoint(point));
  }
  return all;
}

/// Points of small cubes and noisy ones of large cubes. Averaged together, the noise would move the better points; by
/// the spacing of one kind all points of the other are outliers.
template <typename Points>
struct Kinds {
  Points fine, coarse;
  float large_m = 0.0F;    ///< The side of the cloud's large cubes.
  float largest_m = 0.0F;  ///< Side of the largest large cubes of any submap.
};

/// Surfaces have a quarter of the points in cubes of twice the size.
Kinds<std::vector<SurfacePoint>> thinned(const Kinds<std::vector<Piece>>& pieces, const CloudConfig& config) {
  Kinds<std::vector<SurfacePoint>> points;
  auto cube_m = static_cast<float>(config.cube_m);
  while (true) {
    const float large_m = static_cast<float>(common::kLargeCube) * cube_m;
    points = {thinned(pieces.fine, cube_m), thinned(pieces.coarse, large_m), large_m, pieces.largest_m};
    const std::size_t size = points.fine.size() + points.coarse.size();
    if (size <= config.points_max) return points;
    const double surplus = static_cast<double>(size) / static_cast<double>(config.points_max);
    cube_m *= static_cast<float>(std::max(kLeastGrowth, std::sqrt(surplus)));
    points = {};
  }
}

/// Leaves out noisy points that are nearer to a better one, of another submap, than to each other. Within a submap
/// PointGrid has done so.
void removeSeenBetter(Kinds<std::vector<SurfacePoint>>& cloud) {
  if (cloud.coarse.empty()) return;
  const PointsByCube better(cloud.fine, cloud.large_m);
  std::erase_if(cloud.coarse, [&](const SurfacePoint& point) { return better.anyNear(point); });
}

/// The noisy points that are outliers. They are too few beside the others for statistics of their distances.
void removeLone(Kinds<std::vector<SurfacePoint>>& cloud) {
  if (cloud.coarse.empty()) return;
  const float side_m = std::max(cloud.large_m, cloud.largest_m);
  std::unordered_set<std::uint64_t> seen;
  for (const auto* points : {&cloud.fine, &cloud.coarse})
    for (const SurfacePoint& point : *points) seen.insert(keyOf(largeCubeOf(point, side_m)));
  std::erase_if(cloud.coarse, [&](const SurfacePoint& point) {
    int found = 0;  // With its own.
    return !anyAround(largeCubeOf(point, side_m), kAroundCubes,
                      [&](std::uint64_t key) { return seen.count(key) > 0 && ++found > kFewestAround; });
  });
}

/// A part of a cloud with the points around it, for searches: a tree of a whole large cloud takes as much memory as the
/// cloud. A small one is one part.
struct Part {
  std::vector<std::uint32_t> points;  ///< Their indices in the cloud: the part's own points first.
  std::size_t own = 0;
  pcl::PointCloud<pcl::PointXYZ>::Ptr positions = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
};

class Parts {
 public:
  explicit Parts(const std::vector<SurfacePoint>& cloud) : cloud_(cloud), is_whole_(cloud.size() <= kWhole) {
    for (std::size_t i = 0; i < cloud.size(); ++i)
      squares_[squareOf(cloud[i])].push_back(static_cast<std::uint32_t>(i));
  }

  /// `visit(part)` for each part in turn; each point is one part's own.
  template <typename Visit>
  void forEach(const Visit& visit) const {
    for (const auto& [square, own] : squares_) {
      Part part;
      part.points = own;
      part.own = own.size();
      addAround(square, part);
      for (const std::uint32_t i : part.points) {
        const Vector3f& at_m = cloud_[i].position_m;
        part.positions->push_back({at_m.x(), at_m.y(), at_m.z()});
      }
      part.tree.setInputCloud(part.positions);
      visit(part);
    }
  }

 private:
  using Square = std::array<int, 2>;
  /// Points up to which one search tree holds the whole cloud, and the side of the squares of a larger one: a tree over
  /// a large cloud takes as much memory as the cloud (docs/decisions/grid_map.md#081). Other values cost time or memory
  /// and change no result, as a part holds the neighbours beyond its square, too.
  static constexpr std::size_t kWhole = 300'000;
  static constexpr float kSide_m = 5.0F;
  /// Neighbours are nearer: a point whose neighbours are not is an outlier by any measure.
  static constexpr float kAround_m = 0.5F;

  Square squareOf(const SurfacePoint& point) const {
    if (is_whole_) return {0, 0};
    return {static_cast<int>(std::floor(point.position_m.x() / kSide_m)),
            static_cast<int>(std::floor(point.position_m.y() / kSide_m))};
  }
  void addAround(const Square& square, Part& part) const {
    const Vector3f low_m(kSide_m * static_cast<float>(square[0]), kSide_m * static_cast<float>(square[1]), 0.0F);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto beside = squares_.find({square[0] + dx, square[1] + dy});
        if (beside == squares_.end() || (dx == 0 && dy == 0)) continue;
        for (const std::uint32_t i : beside->second) {
          const Vector3f from_low_m = cloud_[i].position_m - low_m;
          const bool near =
              from_low_m.head<2>().minCoeff() >= -kAround_m && from_low_m.head<2>().maxCoeff() <= kSide_m + kAround_m;
          if (near) part.points.push_back(i);
        }
      }
  }

  const std::vector<SurfacePoint>& cloud_;
  bool is_whole_;
  std::map<Square, std::vector<std::uint32_t>> squares_;
};

/// Statistical outlier removal as PCL's class does it, part by part.
void removeOutliers(std::vector<SurfacePoint>& cloud, const CloudConfig& config) {
  if (cloud.size() <= static_cast<std::size_t>(config.neighbours)) return;
  std::vector<float> distances_m(cloud.size(), 0.0F);
  double sum_m = 0.0, squares_m2 = 0.0;
  Parts(cloud).forEach([&](const Part& part) {
    pcl::Indices indices;
    std::vector<float> found_m2;
    for (std::size_t k = 0; k < part.own; ++k) {
      const int found = part.tree.nearestKSearch(static_cast<int>(k), config.neighbours + 1, indices, found_m2);
      double distance_m = 0.0;
      for (int n = 1; n < found; ++n)
        distance_m += std::sqrt(static_cast<double>(found_m2[static_cast<std::size_t>(n)]));
      // Of a point alone in its part the neighbours are farther than a part is wide.
      distance_m = found > config.neighbours ? distance_m / config.neighbours : std::numeric_limits<double>::infinity();
      distances_m[part.points[k]] = static_cast<float>(distance_m);
      if (!std::isfinite(distance_m)) continue;
      sum_m += distance_m;
      squares_m2 += distance_m * distance_m;
    }
  });
  const auto count = static_cast<double>(std::count_if(distances_m.begin(), distances_m.end(),
                                                       [](float distance_m) { return std::isfinite(distance_m); }));
  if (count < 2.0) return;
  const double variance_m2 = (squares_m2 - sum_m * sum_m / count) / (count - 1.0);
  const double most_m = sum_m / count + config.deviations * std::sqrt(std::max(0.0, variance_m2));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (static_cast<double>(distances_m[i]) <= most_m) cloud[kept++] = cloud[i];
  cloud.resize(kept);
}

/// The direction of least spread of the points, on the side of `side`.
Vector3f planeNormal(const pcl::PointCloud<pcl::PointXYZ>& cloud, const pcl::Indices& indices, const Vector3f& side) {
  Eigen::Matrix3f covariance;
  Eigen::Vector4f centroid;
  if (pcl::computeMeanAndCovarianceMatrix(cloud, indices, covariance, centroid) < 3) return Vector3f::Zero();
  float least = 0.0F;
  Vector3f normal;
  pcl::eigen33(covariance, least, normal);
  if (!normal.allFinite()) return Vector3f::Zero();
  return normal.dot(side) < 0.0F ? Vector3f(-normal) : normal;
}

void addMissingNormals(std::vector<SurfacePoint>& cloud) {
  const auto unknown =
      std::count_if(cloud.begin(), cloud.end(), [](const auto& point) { return !isKnown(point.normal); });
  if (unknown == 0 || static_cast<std::size_t>(unknown) == cloud.size()) return;
  std::vector<std::pair<std::uint32_t, Vector3f>> found;  // The missing ones are found from measured ones alone.
  Parts(cloud).forEach([&](const Part& part) {
    pcl::Indices indices;
    std::vector<float> squares_m2;
    for (std::size_t k = 0; k < part.own; ++k) {
      if (isKnown(cloud[part.points[k]].normal)) continue;
      part.tree.nearestKSearch(static_cast<int>(k), kPlaneNeighbours, indices, squares_m2);
      Vector3f side = Vector3f::Zero();
      for (const auto neighbour : indices) side += cloud[part.points[static_cast<std::size_t>(neighbour)]].normal;
      if (side.squaredNorm() > 0.0F) found.emplace_back(part.points[k], planeNormal(*part.positions, indices, side));
    }
  });
  for (const auto& [point, normal] : found) cloud[point].normal = normal;
}

std::vector<SurfacePoint> cleaned(const Kinds<std::vector<Piece>>& pieces, const CloudConfig& config) {
  Kinds<std::vector<SurfacePoint>> kinds = thinned(pieces, config);
  if (config.neighbours > 0) removeOutliers(kinds.fine, config);  // First, as a speck is no better view.
  removeSeenBetter(kinds);
  if (config.neighbours > 0) removeLone(kinds);
  std::vector<SurfacePoint> cloud = std::move(kinds.fine);
  cloud.insert(cloud.end(), kinds.coarse.begin(), kinds.coarse.end());
  if (config.neighbours > 0) addMissingNormals(cloud);
  return cloud;
}

}  // namespace

std::vector<SurfacePoint> cloudOf(const std::vector<common::Submap3d>& submaps, const common::KeyPoses& keys,
                                  const CloudConfig& config) {
  Kinds<std::vector<Piece>> pieces;
  for (const common::Submap3d& submap : submaps) {
    const common::Pose3 T_map_submap = submap.T_map_submap(keys);
    const Eigen::Matrix3f rotation = T_map_submap.rotation.toRotationMatrix().cast<float>();
    const Vector3f origin_m = T_map_submap.position_m.cast<float>();
    const std::span points(*submap.points);
    pieces.fine.push_back({points.first(submap.fine()), rotation, origin_m});
    if (submap.coarse == 0) continue;
    pieces.coarse.push_back({points.last(submap.coarse), rotation, origin_m});
    pieces.largest_m = std::max(pieces.largest_m, static_cast<float>(common::kLargeCube * submap.cube_m));
  }
  return cleaned(pieces, config);
}

}  // namespace swiftlet::mapping3d
