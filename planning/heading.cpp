#include "planning/heading.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "common/validation.hpp"

namespace swiftlet::planning {

void HeadingConfig::describe(common::config::Fields& fields) {
  fields("look_ahead_m", look_ahead_m, "The nose points to the place this far along the path.");
  fields("turn_cost_m_per_rad", turn_cost_m_per_rad, "What a turn is worth, in metres flown backwards.");
  fields("blind_weight", blind_weight, "How much worse a metre flown backwards is than one flown forwards.");
}

std::vector<std::string> HeadingConfig::validate() const {
  return common::Validation()
      .within("look_ahead_m", look_ahead_m, 0.05, 10)
      .within("turn_cost_m_per_rad", turn_cost_m_per_rad, 0, 10)
      .within("blind_weight", blind_weight, 0, 10)
      .problems();
}

double headingAlong(std::span<const Eigen::Vector2d> remaining_map_m, double yaw_map_rad, const HeadingConfig& config) {
  if (remaining_map_m.size() < 2) return yaw_map_rad;
  double length_m = 0.0;
  Eigen::Vector2d ahead_m = remaining_map_m.back();
  for (std::size_t i = 1; i < remaining_map_m.size(); ++i) {
    const Eigen::Vector2d step_m = remaining_map_m[i] - remaining_map_m[i - 1];
    const double step_length_m = step_m.norm(), wanted_m = config.look_ahead_m - length_m;
    if (wanted_m >= 0.0 && step_length_m > wanted_m)
      ahead_m = remaining_map_m[i - 1] + step_m * (wanted_m / step_length_m);
    length_m += step_length_m;
  }
  const Eigen::Vector2d to_m = ahead_m - remaining_map_m.front();
  if (to_m.norm() < 1e-6) return yaw_map_rad;
  const double way_rad = std::atan2(to_m.y(), to_m.x());
  const double off_rad = common::wrapAngle(way_rad - yaw_map_rad);
  const double blind_m = config.blind_weight * length_m * 0.5 * (1.0 - std::cos(off_rad));
  return blind_m > config.turn_cost_m_per_rad * std::abs(off_rad) ? way_rad : yaw_map_rad;
}

}  // namespace swiftlet::planning
