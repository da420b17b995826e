// What a person may do next: one model of how people walk, for all who ask.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/dynamic_obstacle.hpp"

namespace swiftlet::common {

/// A slower person stands.
inline constexpr double kStands_m_s = 0.25;

/// Of a person at that place with that velocity, weights of sum 1. Who walks goes on or turns; who stands stays or sets
/// off in any direction.
std::vector<PossibleWalk> possibleWalks(const Eigen::Vector2d& place_map_m, const Eigen::Vector2d& velocity_map_m_s);

}  // namespace swiftlet::common
