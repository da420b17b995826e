#include "perception/altitude/seen_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swiftlet::perception {
namespace {

constexpr double kResolution_m = 0.1;
/// The noise of a range and of the height are about 1 cm each: beams on one surface differ by less than this.
constexpr double kSame_m = 0.05;
/// A beam that hits an edge measures a height between those of two surfaces. This many of them do not agree on one.
constexpr int kLeastBeams = 5;
constexpr double kLeastShare = 0.02;  ///< Of the beams in a cell; fewer are outliers of the noise.
constexpr int kMostBeams = 1000;      ///< Then the mean follows new beams.
/// Heights are gathered in steps of this.
constexpr double kGathered_m = 0.02;

}  // namespace

void SeenSurfaces::add(const Eigen::Vector2d& point_map_m, double height_m) {
  if (!point_map_m.allFinite() || !std::isfinite(height_m)) return;
  std::vector<Cluster>& clusters = cells_[{static_cast<int>(std::floor(point_map_m.x() / kResolution_m)),
                                           static_cast<int>(std::floor(point_map_m.y() / kResolution_m))}];
  const auto nearest = std::min_element(clusters.begin(), clusters.end(), [&](const Cluster& a, const Cluster& b) {
    return std::abs(a.height_m - height_m) < std::abs(b.height_m - height_m);
  });
  if (nearest == clusters.end() || std::abs(nearest->height_m - height_m) > kSame_m) {
    clusters.push_back({height_m, 1});
    return;
  }
  nearest->beams = std::min(nearest->beams + 1, kMostBeams);
  nearest->height_m += (height_m - nearest->height_m) / nearest->beams;
}

void SeenSurfaces::stood(const Eigen::Vector2d& center_map_m, double radius_m, double height_m) {
  for (double y_m = -radius_m; y_m <= radius_m; y_m += 0.5 * kResolution_m)
    for (double x_m = -radius_m; x_m <= radius_m; x_m += 0.5 * kResolution_m)
      if (std::hypot(x_m, y_m) <= radius_m)
        for (int i = 0; i < kLeastBeams; ++i) add(center_map_m + Eigen::Vector2d(x_m, y_m), height_m);
}

common::LevelMap SeenSurfaces::surfaces() const {
  std::map<int, common::Level> by_height;
  for (const auto& [cell, clusters] : cells_) {
    int beams = 0;
    for (const Cluster& cluster : clusters) beams += cluster.beams;
    for (const Cluster& cluster : clusters)
      if (cluster.beams >= std::max(kLeastBeams, static_cast<int>(kLeastShare * beams)))
        by_height[static_cast<int>(std::lround(cluster.height_m / kGathered_m))].cells.push_back(cell);
  }
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
