// Rays over the states of a cost map, to find what is visible from a place.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {

/// Directions evenly around the circle, the first along +x, each with the step that moves one cell along its greater
/// axis.
class Directions {
 public:
  explicit Directions(int count) {
    for (int i = 0; i < count; ++i) {
      const double angle_rad = 2.0 * std::numbers::pi * i / count;
      const double x = std::cos(angle_rad), y = std::sin(angle_rad), greater = std::max(std::abs(x), std::abs(y));
      rays_.push_back({static_cast<std::int32_t>(std::lround(kOne * x / greater)),
                       static_cast<std::int32_t>(std::lround(kOne * y / greater)), 1.0 / greater});
    }
  }

  static constexpr std::int32_t kOne = 1 << 16;
  struct Ray {
    std::int32_t dx, dy;  ///< In 1 / kOne of a cell.
    double step_cells;    ///< The length of one step.
  };
  const std::vector<Ray>& rays() const { return rays_; }
  int count() const { return static_cast<int>(rays_.size()); }
  double spacing_rad() const { return 2.0 * std::numbers::pi / count(); }

 private:
  std::vector<Ray> rays_;
};

/// Calls visit(index, step) for each cell after `from`, until it returns false, the map ends or `max_steps` are done.
template <typename Visit>
void castRay(const CostMap& map, common::CellIndex from, const Directions::Ray& ray, int max_steps, Visit&& visit) {
  const auto width = static_cast<std::uint32_t>(map.rect().width());
  const auto height = static_cast<std::uint32_t>(map.rect().height());
  std::int32_t x = (from.x - map.rect().begin.x) * Directions::kOne + Directions::kOne / 2;
  std::int32_t y = (from.y - map.rect().begin.y) * Directions::kOne + Directions::kOne / 2;
  for (int step = 1; step <= max_steps; ++step) {
    x += ray.dx;
    y += ray.dy;
    const auto column = static_cast<std::uint32_t>(x >> 16), row = static_cast<std::uint32_t>(y >> 16);
    if (column >= width || row >= height) return;
    if (!visit(static_cast<int>(row * width + column), step)) return;
  }
}

}  // namespace swiftlet::planning
