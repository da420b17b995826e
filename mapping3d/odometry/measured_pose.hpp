// What a frame itself measures of its pose, without its prior, for the filter that the prior came from.
//
// A prior from a filter must not return to it as a measurement: its information would count twice. An alignment with a
// prior solves (H + L) x = H m + L p, with the information H of the frame and L of the prior p. So the measurement is
// m = x + H^-1 L (x - p), with the covariance H^-1. In directions that the frame hardly sees, H cannot be inverted;
// there nothing was measured.
//
// Noise looks like texture: it has gradients, which move with the camera. What they would give is taken out of H, too.
#pragma once

#include "common/geometry.hpp"
#include "mapping3d/odometry/alignment.hpp"

namespace swiftlet::mapping3d {

/// The pose against the key frames alone.
struct MeasuredPose {
  common::Pose3 T_map_camera;
  /// Of the error (x, y, z, rotation vector) in the axes of the camera; very large in directions that were not seen.
  Matrix6d covariance = Matrix6d::Identity();
};

/// `gradient_variance` is that of the frame's noise (vision::gradientNoiseVariance). `depth_m` is a typical depth of
/// the scene: at that distance a turn moves points as much as a step does. A direction counts as seen with more than
/// `least_share` of the information of the one seen best: the noise of normals on a wall seems to give 0.3 % of it
/// along the wall. `sigma_factor` is the standard deviation of the result in those that follow from independent points.
MeasuredPose withoutPrior(const Alignment& fit, double gradient_variance, const PosePrior& prior, double depth_m,
                          double least_share = 0.02, double sigma_factor = 1.0);

}  // namespace swiftlet::mapping3d
