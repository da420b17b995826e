// The point of a triangle that is nearest to another point.
#pragma once

#include <array>

#include <Eigen/Core>

namespace swiftlet::simulation {

/// The triangle may be flat or a single point.
Eigen::Vector3d nearestPoint(const std::array<Eigen::Vector3d, 3>& triangle_m, const Eigen::Vector3d& point_m);

}  // namespace swiftlet::simulation
