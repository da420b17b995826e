#include "perception/altitude/new_surface.hpp"

#include <algorithm>

#include "common/square.hpp"

namespace swiftlet::perception::altitude {

using common::square;
using common::Time;

namespace {

/// Scans in a row that must see a new surface before it becomes a level.
constexpr int kConfirmScans = 3;
/// Time for which a new surface must be seen at one height before it becomes a level (measured:
/// docs/decisions/altitude.md#095).
constexpr double kConfirm_s = 0.3;

/// Of `slope_sigma`: backs of sofas fall by 20 deg below a vehicle, and stay below it for a second.
constexpr double kLikelyShare = 0.5;
constexpr double kLineAfter_s = 0.15;  // A surface seen for a shorter time is assumed to stay at its height.

}  // namespace

double rateVariance_m2_s2(const MultilevelConfig& config, const NewSurface& c) {
  return beamVariance_m2(config, std::max(1, c.beams / c.scans)) / std::max(c.spread_s2(), 1e-9);
}

bool isFlat(const MultilevelConfig& config, const NewSurface& c, Time now, double speed_variance_m2_s2,
            int explained_by) {
  const double seen_s = c.seenFor_s(now);
  if (c.scans < kConfirmScans || seen_s < kConfirm_s) return false;
  const double rate2_m2_s2 = square(c.rate_m_s()), measured_m2_s2 = rateVariance_m2_s2(config, c);
  if (rate2_m2_s2 <= square(config.slope_sigma) * measured_m2_s2) return true;
  const bool known = explained_by != kNoLevel;
  if (!known && seen_s < kConfirmMoving_s) return false;
  const double enough_s = known ? kConfirmMoving_s : kLongestSight_s;
  const double sigma = config.slope_sigma * std::clamp(square(seen_s / enough_s), kLikelyShare, 1.0);
  return rate2_m2_s2 <= square(sigma) * (measured_m2_s2 + speed_variance_m2_s2);
}

void seeNewSurfaces(std::vector<NewSurface>& surfaces, const MultilevelConfig& config, const std::vector<Beam>& beams,
                    double height_m, Time now) {
  for (NewSurface& surface : surfaces) surface.seen = false;
  std::size_t begin = 0;
  while (begin < beams.size()) {
    if (beams[begin].level != kNoLevel) {
      ++begin;
      continue;
    }
    std::size_t end = begin + 1, last = begin;
    double sum_m = beams[begin].distance_below_m;
    int count = 1;
    for (; end < beams.size() && beams[end].distance_below_m - beams[last].distance_below_m <= config.cluster_gap_m;
         ++end) {
      if (beams[end].level != kNoLevel) continue;
      sum_m += beams[end].distance_below_m;
      last = end;
      ++count;
    }
    const bool enough = count >= std::min<int>(config.min_cluster_beams, static_cast<int>(beams.size()));
    if (enough) {
      const double mean_m = sum_m / count, surface_m = height_m - mean_m;
      auto match = std::find_if(surfaces.begin(), surfaces.end(), [&](const NewSurface& c) {
        const double expected_m = c.seenFor_s(now) < kLineAfter_s ? c.height_m() : c.heightAt_m(now);
        return !c.seen &&
               square(expected_m - surface_m) <= 2.0 * square(config.gate_sigma) * beamVariance_m2(config, count);
      });
      if (match == surfaces.end()) match = surfaces.insert(surfaces.end(), NewSurface(now));
      match->add({now, mean_m, count}, surface_m);
      match->seen = true;
      for (std::size_t i = begin; i <= last; ++i)
        if (beams[i].level == kNoLevel) match->cells.push_back(beams[i].cell);
    }
    begin = last + 1;
  }
  std::erase_if(surfaces, [](const NewSurface& c) { return !c.seen; });
}

}  // namespace swiftlet::perception::altitude
