// The flown trail as a path back to its start.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::autonomy {

/// The trail from its end to its start, without the loops: where the vehicle passed an earlier place it continues from
/// there. In the frame of the trail, which must be known to some centimetres.
std::vector<Eigen::Vector2d> trailBackWithoutLoops(std::span<const Eigen::Vector2d> trail_m);

}  // namespace swiftlet::autonomy
