// Where to look while flying a path: the nose along the way, unless the move is too small to be worth the turn
// (Grzonka 2012, section IV-E: trade the cost of rotating for that of flying sideways or backwards).
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config.hpp"

namespace swiftlet::planning {

struct HeadingConfig {
  double look_ahead_m = 0.8;
  double turn_cost_m_per_rad = 0.25;
  double blind_weight = 1.0;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

/// The yaw to aim for in the `map` frame. `remaining_map_m` is what is left of the path, from where the vehicle is.
/// Flying a length d at the angle a off the nose costs `blind_weight` * d * (1 - cos a) / 2; turning costs
/// `turn_cost_m_per_rad` * |a|. The dearer is avoided: 10 cm backwards is flown without turning, 3 m is not.
[[nodiscard]] double headingAlong(std::span<const Eigen::Vector2d> remaining_map_m, double yaw_map_rad,
                                  const HeadingConfig& config);

}  // namespace swiftlet::planning
