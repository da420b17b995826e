// Depth by two cameras: rectification, then the disparity of each pixel by OpenCV, checked from right to left.
//
//   pair --> rectified by the calibration --> disparity --> depth in the left camera, an RGB-D frame like any other
//                                 \--> corners of both: do they lie in one row, the right one to the left?
//
// A depth is f b / d with the focal length f in pixels, the base b and the disparity d; so its standard deviation is
// that of the disparity times z^2 / (f b). Nearer than the greatest disparity nothing is measured.
#pragma once

#include <memory>

#include <tl/expected.hpp>

#include "common/message.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/rgbd_frame.hpp"
#include "vision/features.hpp"

namespace swiftlet::vision {

/// How disparities are found: the sum of absolute differences over a block (Hirschmueller et al., IJCV 47, 2002,
/// without the correction at borders; K. Konolige 1997), or also by the smoothness along some paths through the picture
/// (Hirschmueller, PAMI 30, 2008). Block matching is the faster by far and as exact where there is texture
/// (docs/decisions/cameras_and_lasers.md#118).
enum class StereoMethod { kBlocks, kSemiGlobal };

/// One thread. A function of its calibration and of the pair.
class StereoMatcher {
 public:
  /// The sheet is that of a stereo camera.
  explicit StereoMatcher(const common::RgbdCameraConfig& sheet, StereoMethod method = StereoMethod::kBlocks);
  ~StereoMatcher();
  StereoMatcher(StereoMatcher&&) noexcept;
  StereoMatcher& operator=(StereoMatcher&&) noexcept;

  /// The frame of the left camera, rectified, with the stamps of the pair. A pixel without texture, seen by one camera
  /// alone, or nearer than the sheet's range has no depth; beyond its range it is too far. Fails, with the reason, for
  /// a pair that is not whole, that shows nothing, or that contradicts the calibration.
  tl::expected<common::RgbdFrame, common::Message> match(const common::RgbdFrame& pair);

  /// How the depths err.
  const DepthNoiseConfig& noise() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::vision
