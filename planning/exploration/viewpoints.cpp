#include "planning/exploration/viewpoints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/geometry.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;

/// Rays around a place: for lookouts every 5 degrees, and every 2.5 where these find none; for the gain every 3
/// degrees, which are 0.6 m at the range of 12 m; for walls every 4 degrees.
constexpr int kCoarse = 72, kFine = 144, kGainRays = 120, kWallRays = 90;
/// Outer radii of the rings of lookouts around a frontier: each doubles, so that near and far views compete.
constexpr std::array<double, 5> kRings_m{0.6, 1.2, 2.4, 4.8, std::numeric_limits<double>::infinity()};
/// A place that is nearer to an obstacle than the hull should stop counts as this much farther away.
constexpr double kTight_m = 0.5;
constexpr double kNoPlace = std::numeric_limits<double>::infinity();

/// The heading whose field of view covers the most gain. Of nearly equal headings the smaller turn decides.
double bestHeading(const std::array<double, kGainRays>& gains, double field_of_view_rad, double preferred_yaw_rad,
                   double& gain) {
  // Turning by half a circle must gain a tenth of the area.
  constexpr double kSpacing_rad = 2.0 * std::numbers::pi / kGainRays, kTurnShare = 0.1;
  const int half = std::min(kGainRays / 2, static_cast<int>(0.5 * field_of_view_rad / kSpacing_rad));
  double best_score = -1.0, best_yaw_rad = preferred_yaw_rad;
  for (int i = 0; i < kGainRays; ++i) {
    double sum = 0.0;
    for (int j = i - half; j < i + half; ++j) sum += gains[static_cast<std::size_t>((j + kGainRays) % kGainRays)];
    const double yaw_rad = common::wrapAngle(i * kSpacing_rad);
    const double turn = std::abs(common::wrapAngle(yaw_rad - preferred_yaw_rad)) / std::numbers::pi;
    const double score = sum * (1.0 - kTurnShare * turn) - 1e-9 * turn;
    if (score <= best_score) continue;
    best_score = score;
    best_yaw_rad = yaw_rad;
    gain = sum;
  }
  return best_yaw_rad;
}

}  // namespace

Scout::Scout(const CostMap& map, const CostField& from_vehicle, const ExplorerConfig& config,
             const common::MapBounds* bounds)
    : map_(map),
      field_(from_vehicle),
      config_(config),
      bounds_(bounds),
      coarse_(kCoarse),
      fine_(kFine),
      gain_(kGainRays),
      wall_(kWallRays) {}

std::vector<Lookout> Scout::lookouts(const FrontierRun& frontier) const {
  std::vector<Lookout> rings(kRings_m.size(), {{}, {}, kNoPlace});
  const std::size_t count = frontier.cells.size();
  for (const std::size_t sixth : {3, 1, 5})
    lookFrom(unknownBeside(map_, frontier.cells[std::min(count - 1, count * sixth / 6)]), coarse_, rings);
  const auto none = [](const Lookout& l) { return l.path_m == kNoPlace; };
  if (std::all_of(rings.begin(), rings.end(), none))
    for (std::size_t i = 0; i < count; i += 2) lookFrom(unknownBeside(map_, frontier.cells[i]), fine_, rings);
  std::erase_if(rings, none);
  return rings;
}

void Scout::lookFrom(CellIndex unknown, const Directions& directions, std::vector<Lookout>& rings) const {
  const double resolution_m = map_.resolution_m();
  for (const Directions::Ray& ray : directions.rays()) {
    const int max_steps = static_cast<int>(config_.laser_range_m / resolution_m / ray.step_cells);
    castRay(map_, unknown, ray, max_steps, [&](int index, int step) {
      if (map_.states()[index] != CellState::kFree) return false;
      if (!field_.reached(index)) return true;
      if (bounds_ != nullptr && !bounds_->contains(map_.centerOf(map_.cellOf(index)))) return true;
      const double distance_m = step * ray.step_cells * resolution_m;
      std::size_t ring = 0;
      while (distance_m > kRings_m[ring]) ++ring;
      const bool roomy = hasRoomToStop(map_, map_.cellOf(index));
      const double path_m = field_.cost_m(index, resolution_m) + (roomy ? 0.0 : kTight_m);
      if (path_m < rings[ring].path_m) rings[ring] = {map_.cellOf(index), unknown, path_m};
      return true;
    });
  }
}

View Scout::view(CellIndex place, double preferred_yaw_rad) const {
  static_assert(kGainRays % 2 == 0);
  const double resolution_m = map_.resolution_m();
  std::array<double, kGainRays> gains{};
  std::vector<WallReturn> returns;
  for (int i = 0; i < kGainRays; ++i) {
    const Directions::Ray& ray = gain_.rays()[static_cast<std::size_t>(i)];
    const double step_m = ray.step_cells * resolution_m;
    const int max_steps = static_cast<int>(config_.laser_range_m / step_m);
    const int depth_steps = static_cast<int>(kGainDepth_m / step_m);
    // Steps since the ray left the known space.
    int beyond = 0;
    castRay(map_, place, ray, max_steps, [&](int index, int step) {
      const CellState state = map_.states()[index];
      if (state == CellState::kOccupied) {
        if (beyond == 0)
          returns.push_back({map_.centerOf(map_.cellOf(index)) - map_.centerOf(place), wallNormal(map_, index)});
        return false;
      }
      if (state == CellState::kUnknown)
        gains[static_cast<std::size_t>(i)] += step * step_m * gain_.spacing_rad() * step_m;
      if (state == CellState::kUnknown || beyond > 0) ++beyond;
      return beyond <= depth_steps;
    });
  }
  View view;
  view.localizability = localizability(returns, kGainRays);
  view.yaw_map_rad =
      bestHeading(gains, config_.laser_field_of_view_deg * std::numbers::pi / 180.0, preferred_yaw_rad, view.gain_m2);
  return view;
}

}  // namespace swiftlet::planning
