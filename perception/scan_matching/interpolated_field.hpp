// A likelihood field read between its cells.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "perception/scan_matching/likelihood_field.hpp"

namespace swiftlet::perception {

struct FieldSample {
  double value = 0.0;                                   ///< In (0, 1]; 1: on a contour.
  Eigen::Vector2d slope_1_m = Eigen::Vector2d::Zero();  ///< Exactly the derivative of `value`, per metre.
};

/// Bilinear between the centres of the four cells around a point of the reference frame. Nothing where the point has no
/// support, outside the field, and for a point that is not finite.
std::optional<FieldSample> sampleField(const LikelihoodField& field, const Eigen::Vector2d& point_m);

}  // namespace swiftlet::perception
