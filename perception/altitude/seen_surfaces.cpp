#include "perception/altitude/seen_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swiftlet::perception {
namespace {

constexpr double kResolution_m = 0.1;  ///< That of common::LevelMap, which it becomes.
/// The noise of a range and of the height are about 1 cm each: beams on one surface differ by less than this.
constexpr double kSame_m = 0.05;
/// A beam that hits an edge measures a height between those of two surfaces. This many of them do not agree on one.
constexpr int kLeastBeams = 5;
constexpr double kLeastShare = 0.02;  ///< Of the beams in a cell; fewer are outliers of the noise.
constexpr int kMostBeams = 1000;      ///< Then the mean follows new beams.
/// Heights are gathered in steps of this.
constexpr double kGathered_m = 0.02;

}  // namespace

SeenSurfaces::SeenSurfaces() : cells_(kResolution_m) {}

/// The cluster of the surface that a height belongs to; null if it is none of them.
SeenSurfaces::Cluster* SeenSurfaces::sameAs(std::span<Cluster> clusters, double height_m) {
  const auto nearest = std::min_element(clusters.begin(), clusters.end(), [&](const Cluster& a, const Cluster& b) {
    return std::abs(a.height_m - height_m) < std::abs(b.height_m - height_m);
  });
  return nearest == clusters.end() || std::abs(nearest->height_m - height_m) > kSame_m ? nullptr : &*nearest;
}

void SeenSurfaces::add(const Eigen::Vector2d& point_map_m, double height_m) {
  if (!point_map_m.allFinite() || !std::isfinite(height_m)) return;
  Clusters& clusters = cells_.at(cells_.cellAt(point_map_m)).content;
  Cluster* const same = sameAs(clusters, height_m);
  if (same == nullptr) {
    clusters.push_back({height_m, 1});
    return;
  }
  same->beams = std::min(same->beams + 1, kMostBeams);
  same->height_m += (height_m - same->height_m) / same->beams;
}

void SeenSurfaces::stood(const Eigen::Vector2d& center_map_m, double radius_m, double height_m) {
  for (double y_m = -radius_m; y_m <= radius_m; y_m += 0.5 * kResolution_m)
    for (double x_m = -radius_m; x_m <= radius_m; x_m += 0.5 * kResolution_m)
      if (std::hypot(x_m, y_m) <= radius_m)
        for (int i = 0; i < kLeastBeams; ++i) add(center_map_m + Eigen::Vector2d(x_m, y_m), height_m);
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
      if (cluster.beams >= std::max(kLeastBeams, static_cast<int>(kLeastShare * beams)))
        by_height[static_cast<int>(std::lround(cluster.height_m / kGathered_m))].cells.push_back(cell);
  });
  common::LevelMap map;
  map.resolution_m = kResolution_m;
  for (auto& [step, level] : by_height) {
    level.id = static_cast<int>(map.levels.size());
    level.height_m = step * kGathered_m;
    map.levels.push_back(std::move(level));
  }
  return map;
}

}  // namespace swiftlet::perception
