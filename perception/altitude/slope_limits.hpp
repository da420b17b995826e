// Limits that distinguish slopes of the ground from level ground.
#pragma once

namespace swiftlet::perception {

/// Ground whose gradient (rise over run) is less counts as level: 4 degrees, twice what attitude and mount are wrong
/// by.
inline constexpr double kLeastGradient = 0.07;
/// What is steeper, 25 degrees, is no ramp but furniture or a wall.
inline constexpr double kSteepestGradient = 0.47;

}  // namespace swiftlet::perception
