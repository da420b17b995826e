#include "planning/costs/surface_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swiftlet::planning {

SurfaceSteps surfaceSteps(const CellStates& cells, const common::LevelMap* levels, std::int32_t cost_per_cm) {
  // Less than 1 cm of height is no step: heights are kept in centimetres.
  constexpr double kLeast_m = 0.01, kGreatest_m = SurfaceSteps::kGreatest_cm / 100.0;
  SurfaceSteps steps{{}, cost_per_cm};
  const bool flat =
      levels == nullptr || std::all_of(levels->levels.begin(), levels->levels.end(),
                                       [](const common::Level& level) { return std::abs(level.height_m) < kLeast_m; });
  if (flat) return steps;
  constexpr std::int16_t kNoLevel = std::numeric_limits<std::int16_t>::min();
  steps.heights_cm.assign(cells.all().size(), kNoLevel);
  for (const common::Level& level : levels->levels) {
    const auto height_cm = static_cast<std::int16_t>(
        std::lround(std::clamp(level.height_m, -0.5 * kGreatest_m, 0.5 * kGreatest_m) * 100.0));
    for (const common::CellIndex cell : level.cells) {
      const Eigen::Vector2d low_m{cell.x * levels->resolution_m, cell.y * levels->resolution_m};
      const common::CellIndex low = cells.grid().cellAt(low_m),
                              high = cells.grid().cellAt(low_m + Eigen::Vector2d::Constant(levels->resolution_m));
      for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
          const Eigen::Vector2d offset_m = cells.grid().centerOf({x, y}) - low_m;
          if (!cells.rect().contains({x, y}) || offset_m.minCoeff() < 0.0 ||
              offset_m.maxCoeff() >= levels->resolution_m)
            continue;
          std::int16_t& known_cm = steps.heights_cm[static_cast<std::size_t>(cells.indexOf({x, y}))];
          known_cm = std::max(known_cm, height_cm);
        }
      }
    }
  }
  std::replace(steps.heights_cm.begin(), steps.heights_cm.end(), kNoLevel, std::int16_t{0});  // The take-off floor.
  return steps;
}

}  // namespace swiftlet::planning
