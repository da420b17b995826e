// What ground is, and how well it is measured: shared by all that looks at it.
#pragma once

namespace swiftlet::perception {

/// Two measurements of one thing differ by less than so many standard deviations.
inline constexpr double kSigmas = 3.0;
/// One measurement alone may be an outlier; so many beams, planes or images must agree.
inline constexpr int kAgreeing = 2;

/// Side of a cell of common::LevelMap.
inline constexpr double kCell_m = 0.1;
/// Standard deviation of a real surface from flat, shared by all beams of a scan: no level is known better.
inline constexpr double kFlatness_m = 0.005;
/// Heights that differ by more belong to two surfaces: six standard deviations of one beam (UTM-30LX: 0.01 m).
inline constexpr double kSurfaceGap_m = 0.06;

/// The points of a plane are this near to it (RMS); with an edge among them they are not.
inline constexpr double kPlane_m = 0.03;
/// The standard deviation of a gradient (rise over run): what is left of the error of attitude and mount; 0.016 over
/// eight ramps of trials/ramp.yaml.
inline constexpr double kGradientSigma = 0.02;
/// Ground whose gradient is less counts as level.
inline constexpr double kLeastGradient = kSigmas * kGradientSigma;
/// What is steeper, 25 degrees, is no ramp but furniture or a wall.
inline constexpr double kSteepestGradient = 0.47;

}  // namespace swiftlet::perception
