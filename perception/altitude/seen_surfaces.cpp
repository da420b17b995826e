#include "perception/altitude/seen_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "perception/altitude/ground_limits.hpp"

namespace swiftlet::perception {
namespace {

/// Of the beams in a cell. Fewer hit an edge, or are from a moment when the height was wrong.
constexpr double kLeastShare = 0.02;
/// Heights are gathered in steps of this: within it a surface is flat.
constexpr double kGathered_m = 2.0 * kFlatness_m;

}  // namespace

SeenSurfaces::SeenSurfaces() : cells_(kCell_m) {}

/// The cluster of the surface that a height belongs to; null if it is none of them.
SeenSurfaces::Cluster* SeenSurfaces::sameAs(std::span<Cluster> clusters, double height_m) {
  const auto nearest = std::min_element(clusters.begin(), clusters.end(), [&](const Cluster& a, const Cluster& b) {
    return std::abs(a.height_m - height_m) < std::abs(b.height_m - height_m);
  });
  return nearest == clusters.end() || std::abs(nearest->height_m - height_m) > kSurfaceGap_m ? nullptr : &*nearest;
}

void SeenSurfaces::add(const Eigen::Vector2d& point_map_m, double height_m) {
  if (!point_map_m.allFinite() || !std::isfinite(height_m)) return;
  Clusters& clusters = cells_.at(cells_.cellAt(point_map_m)).content;
  Cluster* const same = sameAs(clusters, height_m);
  if (same == nullptr) {
    clusters.push_back({height_m, 1});
    return;
  }
  same->height_m += (height_m - same->height_m) / ++same->beams;
}

void SeenSurfaces::stood(const Eigen::Vector2d& center_map_m, double radius_m, double height_m) {
  for (double y_m = -radius_m; y_m <= radius_m; y_m += 0.5 * kCell_m)
    for (double x_m = -radius_m; x_m <= radius_m; x_m += 0.5 * kCell_m)
      if (std::hypot(x_m, y_m) <= radius_m)
        for (int i = 0; i < kAgreeing; ++i) add(center_map_m + Eigen::Vector2d(x_m, y_m), height_m);
}

/// Of all squares that a cell has. What two passes saw of one surface counts together.
SeenSurfaces::Clusters SeenSurfaces::clustersAt(common::CellIndex cell) const {
  Clusters all;
  cells_.visit(cell, [&](const KeyedCells<Clusters>::Square& square) {
    const std::size_t known = all.size();
    for (const Cluster& cluster : square.content) {
      Cluster* const same = sameAs(std::span(all).first(known), cluster.height_m);
      if (same == nullptr) {
        all.push_back(cluster);
        continue;
      }
      same->height_m += (cluster.height_m - same->height_m) * cluster.beams / (same->beams + cluster.beams);
      same->beams += cluster.beams;
    }
  });
  return all;
}

common::LevelMap SeenSurfaces::surfaces() const {
  std::map<int, common::Level> by_height;
  cells_.visitCells([&](common::CellIndex cell) {
    const Clusters clusters = clustersAt(cell);
    int beams = 0;
    for (const Cluster& cluster : clusters) beams += cluster.beams;
    for (const Cluster& cluster : clusters)
      if (cluster.beams >= std::max(kAgreeing, static_cast<int>(kLeastShare * beams)))
        by_height[static_cast<int>(std::lround(cluster.height_m / kGathered_m))].cells.push_back(cell);
  });
  common::LevelMap map;
  map.resolution_m = kCell_m;
  for (auto& [step, level] : by_height) {
    level.id = static_cast<int>(map.levels.size());
    level.height_m = step * kGathered_m;
    map.levels.push_back(std::move(level));
  }
  return map;
}

}  // namespace swiftlet::perception
