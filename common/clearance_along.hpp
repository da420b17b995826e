// How much room a straight line leaves, as it is told to who shapes a path and has no map.
#pragma once

#include <functional>

#include <Eigen/Core>

namespace swiftlet::common {

/// The least distance from the middle of the hull to all that it must not touch, along a straight line between two
/// places of the body; not more than what is enough. Null where nothing is known of it.
using ClearanceAlong = std::function<double(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m)>;

}  // namespace swiftlet::common
