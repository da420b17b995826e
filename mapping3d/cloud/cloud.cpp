#include "mapping3d/cloud/cloud.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
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

/// Calls its argument for each point, the same ones in the same order each time. A list of all points of a large map
/// would take as much memory as the map.
using PointSource = std::function<void(const std::function<void(const SurfacePoint&)>&)>;
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

/// The points by tiles whose borders are borders of cubes. They are counted first: a cloud that grows takes up to twice
/// its memory.
std::map<TileIndex, PclCloud::Ptr> tilesOf(const PointSource& points, float cube_m) {
  std::map<TileIndex, std::size_t> sizes;
  points([&](const SurfacePoint& point) {
    if (const auto tile = tileOf(point, cube_m)) ++sizes[*tile];
  });
  std::map<TileIndex, PclCloud::Ptr> tiles;
  for (const auto& [index, size] : sizes) {
    tiles[index] = pcl::make_shared<PclCloud>();
    tiles[index]->reserve(size);
  }
  points([&](const SurfacePoint& point) {
    if (const auto tile = tileOf(point, cube_m)) tiles[*tile]->push_back(pclPoint(point));
  });
  return tiles;
}

/// One point a cube. Opposite normals of a thin wall may cancel each other: the point has none then.
PclCloud::Ptr thinned(const PointSource& points, float cube_m) {
  std::map<TileIndex, PclCloud::Ptr> tiles = tilesOf(points, cube_m);
  std::size_t size = 0;
  for (auto& [index, tile] : tiles) {
    pcl::VoxelGrid<PclPoint> grid;
    grid.setLeafSize(cube_m, cube_m, cube_m);
    grid.setDownsampleAllData(true);
    grid.setInputCloud(tile);
    auto kept = pcl::make_shared<PclCloud>();
    grid.filter(*kept);
    tile = kept;
    size += kept->size();
  }
  auto all = pcl::make_shared<PclCloud>();
  all->reserve(size);
  for (auto& [index, tile] : tiles) *all += *std::exchange(tile, nullptr);
  for (PclPoint& point : *all)
    if (!point.getNormalVector3fMap().allFinite() || !isKnown(point.getNormalVector3fMap()))
      point.getNormalVector3fMap().setZero();
  return all;
}

/// Surfaces have a quarter of the points in cubes of twice the size.
PclCloud::Ptr thinned(const PointSource& points, const CloudConfig& config) {
  auto cube_m = static_cast<float>(config.cube_m);
  PclCloud::Ptr cloud = thinned(points, cube_m);
  while (cloud->size() > config.points_max) {
    const double surplus = static_cast<double>(cloud->size()) / static_cast<double>(config.points_max);
    cube_m *= static_cast<float>(std::max(kLeastGrowth, std::sqrt(surplus)));
    cloud = thinned(points, cube_m);
  }
  return cloud;
}

PclCloud::Ptr withoutOutliers(const PclCloud::Ptr& cloud, const CloudConfig& config) {
  if (cloud->size() <= static_cast<std::size_t>(config.neighbours)) return cloud;
  pcl::StatisticalOutlierRemoval<PclPoint> filter;
  filter.setInputCloud(cloud);
  filter.setMeanK(config.neighbours);
  filter.setStddevMulThresh(config.deviations);
  auto kept = pcl::make_shared<PclCloud>();
  filter.filter(*kept);
  return kept;
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
  const PclCloud measured = *cloud;
  pcl::Indices indices;
  std::vector<float> squares_m2;
  for (const std::size_t i : missing) {
    tree.nearestKSearch(measured[i], kPlaneNeighbours, indices, squares_m2);
    Vector3f side = Vector3f::Zero();
    for (const auto neighbour : indices) side += measured[static_cast<std::size_t>(neighbour)].getNormalVector3fMap();
    if (side.squaredNorm() > 0.0F) (*cloud)[i].getNormalVector3fMap() = planeNormal(measured, indices, side);
  }
}

std::vector<SurfacePoint> cleaned(const PointSource& points, const CloudConfig& config) {
  PclCloud::Ptr cloud = thinned(points, config);
  if (config.neighbours > 0) {
    cloud = withoutOutliers(cloud, config);
    addMissingNormals(cloud);
  }
  std::vector<SurfacePoint> kept;
  kept.reserve(cloud->size());
  for (const PclPoint& point : *cloud) kept.push_back(surfacePoint(point));
  return kept;
}

}  // namespace

std::vector<SurfacePoint> cleanCloud(const std::vector<SurfacePoint>& points, const CloudConfig& config) {
  return cleaned([&](const auto& visit) { std::for_each(points.begin(), points.end(), visit); }, config);
}

std::vector<SurfacePoint> cloudOf(const std::vector<common::Submap3d>& submaps, const common::KeyPoses& keys,
                                  const CloudConfig& config) {
  const auto points = [&](const std::function<void(const SurfacePoint&)>& visit) {
    for (const common::Submap3d& submap : submaps) {
      const common::Pose3 T_map_submap = submap.T_map_submap(keys);
      const Eigen::Matrix3f rotation = T_map_submap.rotation.toRotationMatrix().cast<float>();
      const Vector3f origin_m = T_map_submap.position_m.cast<float>();
      for (const SurfacePoint& point : *submap.points)
        visit({rotation * point.position_m + origin_m, rotation * point.normal, point.rgb});
    }
  };
  return cleaned(points, config);
}

}  // namespace swiftlet::mapping3d
