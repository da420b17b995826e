// The courses of a retreat by the rules of two papers. Neither checks what lies on its course: they are here to be
// compared with `retreatChoice`, which does.
#pragma once

#include <Eigen/Core>

#include "planning/avoidance/avoidance_config.hpp"
#include "planning/avoidance/retreat.hpp"

namespace swiftlet::planning {

/// At `retreat_speed_m_s` away from the nearest dangerous threat: the waypoint 180 deg from the collision bin (Saeedi,
/// III-G). In the level frame; zero without a dangerous threat.
Eigen::Vector2d oppositeVelocity(const AvoidanceConfig& config, double hull_radius_m, const RetreatInput& input);

/// Along the sum of the repulsive forces of all returns and threats within 1 m of the hull, each (1 / d - 1
/// / d0) / d^2 away from it (Grzonka 2012, IV-E, after Khatib 1986, equation 15), at most at `retreat_speed_m_s`. In
/// the level frame; zero where nothing repels or the forces cancel.
Eigen::Vector2d potentialFieldVelocity(const AvoidanceConfig& config, double hull_radius_m, const RetreatInput& input);

}  // namespace swiftlet::planning
