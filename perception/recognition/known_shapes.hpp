// The closed curves of a template, as it looks at several sizes: small shapes appear only from near, and from afar
// neighbours merge.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "perception/recognition/pattern_template.hpp"
#include "perception/recognition/polar_patch.hpp"

namespace swiftlet::perception {

/// A closed curve of the template.
struct KnownShape {
  PolarPatch patch;
  Eigen::Vector2d middle_m;       ///< In the frame of the pattern.
  Eigen::Matrix2d whitening_1_m;  ///< From differences on the paper to the whitened frame, in which v counts down.
};

/// The outline of the paper is one of them. Shapes that look the same at another size are there once.
std::vector<KnownShape> knownShapes(const PatternTemplate& pattern);

}  // namespace swiftlet::perception
