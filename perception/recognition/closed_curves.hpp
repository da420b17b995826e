// Closed curves of a picture: the outlines of what is brighter or darker than its surroundings. An affine map keeps
// them, so that the moments of the area inside give a frame of reference that turns, stretches and slants with the
// paper (J. Matas et al., "Robust wide baseline stereo from maximally stable extremal regions", BMVC 2002; S.
// Obdrzalek, J. Matas, "Object recognition using local affine frames on distinguished regions", BMVC 2002).
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vision/gray_image.hpp"

namespace swiftlet::perception {

/// The area inside of a curve.
struct ClosedCurve {
  Eigen::Vector2d middle_px;
  /// Maps the area to one with unit second moments, up to a rotation: shape * (pixel - middle_px). Its determinant is
  /// positive.
  Eigen::Matrix2d whitening;
  double area_px2 = 0.0;
};

/// Curves around at least `kLeastCurveArea_px2` pixels that do not touch the border, in the order of the picture.
/// `contrast` is by how many grey levels a pixel must differ from the mean around it.
std::vector<ClosedCurve> findClosedCurves(const vision::GrayImage& gray, int contrast);

}  // namespace swiftlet::perception
