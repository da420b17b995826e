#include "perception/altitude/ground_scan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/square.hpp"

namespace swiftlet::perception::altitude {

using common::square;

namespace {

/// Twice the range of the laser that the shipped profiles have (UTM-30LX: 30 m). Farther is a defective value.
constexpr double kFarthest_m = 60.0;

}  // namespace

double beamVariance_m2(const MultilevelConfig& config, int averaged) {
  return square(config.beam_noise_m) / averaged + square(config.surface_noise_m);
}

void GroundScan::read(const Eigen::Vector2d& position_map_m, std::span<const GroundPoint> points,
                      const LevelStore& store) {
  beams.clear();
  Eigen::Vector2d sum_m = Eigen::Vector2d::Zero();
  for (const GroundPoint& point : points) {
    const bool usable = point.position_map_m.allFinite() && std::isfinite(point.distance_below_m) &&
                        point.distance_below_m > 0.0 && point.distance_below_m < kFarthest_m;
    if (!usable) continue;
    beams.push_back({store.cellAt(point.position_map_m), point.distance_below_m, kNoLevel});
    sum_m += point.position_map_m;
  }
  std::sort(beams.begin(), beams.end(), [](const Beam& a, const Beam& b) {
    return std::pair(a.distance_below_m, a.cell) < std::pair(b.distance_below_m, b.cell);
  });
  center = store.cellAt(beams.empty() ? position_map_m : Eigen::Vector2d(sum_m / static_cast<double>(beams.size())));
}

std::size_t GroundScan::endOfSurface(std::size_t begin, double gap_m) const {
  std::size_t end = begin + 1;
  while (end < beams.size() && beams[end].distance_below_m - beams[end - 1].distance_below_m <= gap_m) ++end;
  return end;
}

void GroundScan::group(const LevelStore& store) {
  groups.clear();
  for (const Beam& beam : beams) {
    if (beam.level == kNoLevel) continue;
    auto group = std::find_if(groups.begin(), groups.end(), [&](const BeamGroup& g) { return g.level == beam.level; });
    if (group == groups.end()) {
      const LevelEstimate& level = store.at(beam.level);
      groups.push_back({beam.level, 0, 0.0, level.height_m, level.variance_m2});
      group = groups.end() - 1;
    }
    ++group->beams;
    group->distance_below_m += (beam.distance_below_m - group->distance_below_m) / group->beams;
  }
  std::sort(groups.begin(), groups.end(), [](const BeamGroup& a, const BeamGroup& b) { return a.level < b.level; });
}

std::optional<double> GroundScan::distanceToSurface_m(int needed_beams, double gap_m) const {
  const std::size_t needed = std::min<std::size_t>(static_cast<std::size_t>(needed_beams), beams.size());
  for (std::size_t i = 0; needed > 0 && i + needed <= beams.size(); ++i) {
    const double nearest_m = beams[i].distance_below_m;
    if (beams[i + needed - 1].distance_below_m - nearest_m > gap_m) continue;
    double sum_m = 0.0;
    std::size_t n = 0;
    for (std::size_t k = i; k < beams.size() && beams[k].distance_below_m - nearest_m <= gap_m; ++k, ++n)
      sum_m += beams[k].distance_below_m;
    return sum_m / static_cast<double>(n);
  }
  return std::nullopt;
}

}  // namespace swiftlet::perception::altitude
