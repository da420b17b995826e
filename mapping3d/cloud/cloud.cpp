#include "mapping3d/cloud/cloud.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include <pcl/common/centroid.h>
#include <pcl/common/eigen.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

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
  const std::vector<SurfacePoint>* points;
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  Vector3f origin_m = Vector3f::Zero();

  SurfacePoint at(std::size_t index) const {
    const SurfacePoint& point = (*points)[index];
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
    for (std::size_t i = 0; i < piece.points->size(); ++i) {
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
    for (std::size_t i = 0; i < share.piece->points->size(); ++i) {
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
  for (const Piece& piece : pieces) size += piece.points->size();
  return size;
}

/// One point a cube, made tile by tile: PCL's points take twice the memory of the map's. `convert` makes a point of the
/// result from one of PCL's.
template <typename Points, typename Convert>
Points thinned(const std::vector<Piece>& pieces, float cube_m, const Convert& convert) {
  Points all;
  all.reserve(sizeOf(pieces));  // What is not used of it is never touched, so that it takes no memory.
  for (const auto& [tile, shares] : tilesOf(pieces, cube_m)) {
    pcl::VoxelGrid<PclPoint> grid;
    grid.setLeafSize(cube_m, cube_m, cube_m);
    grid.setDownsampleAllData(true);
    grid.setInputCloud(cloudOf(tile, shares, cube_m));
    PclCloud kept;
    grid.filter(kept);
    clearUnknownNormals(kept);
    for (const PclPoint& point : kept) all.push_back(convert(point));
  }
  return all;
}

/// Surfaces have a quarter of the points in cubes of twice the size.
template <typename Points, typename Convert>
Points thinned(const std::vector<Piece>& pieces, const CloudConfig& config, const Convert& convert) {
  auto cube_m = static_cast<float>(config.cube_m);
  auto points = thinned<Points>(pieces, cube_m, convert);
  while (points.size() > config.points_max) {
    const double surplus = static_cast<double>(points.size()) / static_cast<double>(config.points_max);
    cube_m *= static_cast<float>(std::max(kLeastGrowth, std::sqrt(surplus)));
    points = Points();
    points = thinned<Points>(pieces, cube_m, convert);
  }
  return points;
}

void removeOutliers(const PclCloud::Ptr& cloud, const CloudConfig& config) {
  if (cloud->size() <= static_cast<std::size_t>(config.neighbours)) return;
  pcl::StatisticalOutlierRemoval<PclPoint> filter;
  filter.setInputCloud(cloud);
  filter.setMeanK(config.neighbours);
  filter.setStddevMulThresh(config.deviations);
  pcl::Indices kept;  // In ascending order.
  filter.filter(kept);
  for (std::size_t i = 0; i < kept.size(); ++i) (*cloud)[i] = (*cloud)[static_cast<std::size_t>(kept[i])];
  cloud->resize(kept.size());
}

/// The direction of least spread of the points, on the side of `side`.
Vector3f planeNormal(const PclCloud& cloud, const pcl::Indices& indices, const Vector3f& side) {
  Eigen::Matrix3f covariance;
  Eigen::Vector4f centroid;
  if (pcl::computeMeanAndCovarianceMatrix(cloud, indices, covariance, centroid) < 3) return Vector3f::Zero();
  float least = 0.0F;
  Vector3f normal;
  pcl::eigen33(covariance, least, normal);
  if (!normal.allFinite()) return Vector3f::Zero();
  return normal.dot(side) < 0.0F ? Vector3f(-normal) : normal;
}

void addMissingNormals(const PclCloud::Ptr& cloud) {
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < cloud->size(); ++i)
    if (!isKnown((*cloud)[i].getNormalVector3fMap())) missing.push_back(i);
  if (missing.empty() || missing.size() == cloud->size()) return;
  pcl::KdTreeFLANN<PclPoint> tree;
  tree.setInputCloud(cloud);
  std::vector<Vector3f> normals;  // Of the missing ones; those are found from measured ones alone.
  pcl::Indices indices;
  std::vector<float> squares_m2;
  for (const std::size_t i : missing) {
    tree.nearestKSearch((*cloud)[i], kPlaneNeighbours, indices, squares_m2);
    Vector3f side = Vector3f::Zero();
    for (const auto neighbour : indices) side += (*cloud)[static_cast<std::size_t>(neighbour)].getNormalVector3fMap();
    normals.push_back(side.squaredNorm() > 0.0F ? planeNormal(*cloud, indices, side) : Vector3f(Vector3f::Zero()));
  }
  for (std::size_t i = 0; i < missing.size(); ++i) (*cloud)[missing[i]].getNormalVector3fMap() = normals[i];
}

std::vector<SurfacePoint> cleaned(const std::vector<Piece>& pieces, const CloudConfig& config) {
  if (config.neighbours == 0) return thinned<std::vector<SurfacePoint>>(pieces, config, surfacePoint);
  const auto cloud = pcl::make_shared<PclCloud>(
      thinned<PclCloud>(pieces, config, [](const PclPoint& point) -> const PclPoint& { return point; }));
  removeOutliers(cloud, config);
  addMissingNormals(cloud);
  std::vector<SurfacePoint> kept;
  kept.reserve(cloud->size());
  for (const PclPoint& point : *cloud) kept.push_back(surfacePoint(point));
  return kept;
}

}  // namespace

std::vector<SurfacePoint> cleanCloud(const std::vector<SurfacePoint>& points, const CloudConfig& config) {
  return cleaned({{&points}}, config);
}

std::vector<SurfacePoint> cloudOf(const std::vector<common::Submap3d>& submaps, const common::KeyPoses& keys,
                                  const CloudConfig& config) {
  std::vector<Piece> pieces;
  for (const common::Submap3d& submap : submaps) {
    const common::Pose3 T_map_submap = submap.T_map_submap(keys);
    pieces.push_back({submap.points.get(), T_map_submap.rotation.toRotationMatrix().cast<float>(),
                      T_map_submap.position_m.cast<float>()});
  }
  return cleaned(pieces, config);
}

}  // namespace swiftlet::mapping3d
