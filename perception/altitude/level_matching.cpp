#include "perception/altitude/level_matching.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/square.hpp"

namespace swiftlet::perception::altitude {

using common::square;

namespace {

/// A level that was not seen for this long counts as entered again when it is seen.
constexpr double kEnterAfter_s = 0.3;
/// Unknown surfaces to be expected, for each metre of height and each known one.
constexpr double kUnknownPer_m = 1.0;
/// Factor by which the take-off floor is likelier to be met than another level.
constexpr double kFloorWeight = 10.0;
/// Nothing is less than this below the take-off floor (docs/decisions/altitude.md#008).
constexpr double kLeastStepDown_m = 0.25;

// Beyond the gate, an error of the height is likelier than a step down from the floor.
constexpr double kFarBelow_sigma = 8.0;

bool isBelow(const Neighbourhood& known, const LevelEstimate& level) {
  return level.seen && (known.now - level.last.stamp).seconds() <= kEnterAfter_s && known.now >= level.distrusted_until;
}

}  // namespace

bool likelierThanUnknown(int id, double residual_m, double variance_m2) {
  const double density_per_m =
      std::exp(-0.5 * square(residual_m) / variance_m2) / std::sqrt(2.0 * std::numbers::pi * variance_m2);
  return (id == kFloor ? kFloorWeight : 1.0) * density_per_m > kUnknownPer_m;
}

int likeliestLevel(const Neighbourhood& known, double distance_below_m, int averaged, bool known_below) {
  const MultilevelConfig& config = known.config;
  const HeightFilter& height = known.height;
  int likeliest = kNoLevel;
  double best = square(config.gate_sigma);
  for (const int id : known.near) {
    const LevelEstimate& level = known.store.at(id);
    if (known_below && !isBelow(known, level)) continue;
    const double residual_m = height.height_m() - level.height_m - distance_below_m;
    // If the height is already measured against the level, both share the level's error.
    const double level_m2 = known_below ? std::max(0.0, level.variance_m2 - height.referenceVariance_m2())
                                        : level.variance_m2 + height.referenceVariance_m2();
    const double variance_m2 = height.ownVariance_m2() + level_m2 + beamVariance_m2(config, averaged);
    // Nothing lies just below the take-off floor: a surface that seems to is the floor, and the height is wrong.
    const bool sunk_floor = !known_below && config.one_floor && id == kFloor && residual_m < 0.0 &&
                            residual_m > -std::max(kLeastStepDown_m, kFarBelow_sigma * std::sqrt(variance_m2));
    if (square(residual_m) > best * variance_m2 && !(sunk_floor && likeliest == kNoLevel)) continue;
    if (!known_below && !sunk_floor && !likelierThanUnknown(id, residual_m, variance_m2)) continue;
    best = std::min(best, square(residual_m) / variance_m2);
    likeliest = id;
  }
  return likeliest;
}

void matchBeams(const Neighbourhood& known, GroundScan& scan) {
  std::vector<Beam>& beams = scan.beams;
  for (Beam& beam : beams) beam.level = kNoLevel;
  for (std::size_t begin = 0, end = 0; begin < beams.size(); begin = end) {
    end = scan.endOfSurface(begin, known.config.cluster_gap_m);
    const int count = static_cast<int>(end - begin);
    if (likeliestLevel(known, beams[begin + (end - begin) / 2].distance_below_m, count, true) == kNoLevel) continue;
    for (std::size_t i = begin; i < end; ++i)
      beams[i].level = likeliestLevel(known, beams[i].distance_below_m, 1, true);
  }
}

}  // namespace swiftlet::perception::altitude
