#include "perception/altitude/ground_scan.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "perception/altitude/ground_limits.hpp"

namespace swiftlet::perception::altitude {
std::vector<SurfaceSight> surfacesBelow(std::span<const GroundPoint> points, const LevelStore& store) {
  std::vector<const GroundPoint*> beams;
  beams.reserve(points.size());
  for (const GroundPoint& point : points) {
    const bool usable =
        point.position_map_m.allFinite() && std::isfinite(point.distance_below_m) && point.distance_below_m > 0.0;
    if (usable) beams.push_back(&point);
  }
  const auto key = [](const GroundPoint* beam) {
    return std::tuple(beam->distance_below_m, beam->position_map_m.x(), beam->position_map_m.y());
  };
  std::sort(beams.begin(), beams.end(), [&](const GroundPoint* a, const GroundPoint* b) { return key(a) < key(b); });
  std::vector<SurfaceSight> sights;
  for (std::size_t begin = 0, end = 0; begin < beams.size(); begin = end) {
    end = begin + 1;
    while (end < beams.size() && beams[end]->distance_below_m - beams[end - 1]->distance_below_m <= kSurfaceGap_m)
      ++end;
    if (end - begin < std::min<std::size_t>(kAgreeing, beams.size())) continue;
    SurfaceSight sight;
    sight.beams = static_cast<int>(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      sight.distance_below_m += beams[i]->distance_below_m / sight.beams;
      sight.center_map_m += beams[i]->position_map_m / sight.beams;
      sight.cells.push_back(store.cellAt(beams[i]->position_map_m));
    }
    sights.push_back(std::move(sight));
  }
  std::stable_sort(sights.begin(), sights.end(),
                   [](const SurfaceSight& a, const SurfaceSight& b) { return a.beams > b.beams; });
  return sights;
}

std::optional<double> distanceToHighest_m(std::span<const SurfaceSight> sights) {
  std::optional<double> least_m;
  for (const SurfaceSight& sight : sights)
    if (!least_m || sight.distance_below_m < *least_m) least_m = sight.distance_below_m;
  return least_m;
}

}  // namespace swiftlet::perception::altitude
