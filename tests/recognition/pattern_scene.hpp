// Pictures of a printed pattern, as a camera of 752x480 takes them: 6 degrees of freedom by a low-discrepancy sequence,
// and light, shading, motion blur, occlusion, noise, background and decoys at random. The same scene can be rendered
// with another print in the pattern's place.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "perception/recognition/pattern_template.hpp"
#include "perception/recognition/recognizer.hpp"
#include "vision/gray_image.hpp"

namespace swiftlet::perception {

/// Focal length of 460 px.
common::PinholeCamera sceneCamera();

/// A sheet of paper in space.
struct PlacedSheet {
  common::Pose3 T_camera_sheet;
  double size_px = 0.0;   ///< Square root of the area that it covers.
  double tilt_rad = 0.0;  ///< Between its normal and the view to its middle.
};

/// Everything that is random in a picture.
struct PatternScene {
  std::uint64_t seed = 0, index = 0;
  bool has_pattern = true;
  double width_m = 0.0;  ///< Of every sheet, which is a square.
  PlacedSheet pattern;
  std::vector<PlacedSheet> decoys;
  double occluded_share = 0.0;  ///< Of the pattern, by a strip or a disc.
  double brightness = 1.0;      ///< Of the whole picture.
  double shading = 0.0;         ///< Change of the brightness from one side of the picture to the other.
  double motion_px = 0.0;       ///< Length of the motion during the exposure.
  double noise = 0.0;           ///< Standard deviation, in grey levels.
};

/// The scene `index` of those that `seed` gives. Every second one has no pattern.
PatternScene drawScene(std::uint64_t seed, std::uint64_t index, double width_m);

/// What is printed on the sheets. Squares.
struct Prints {
  vision::GrayImage pattern;
  std::vector<vision::GrayImage> decoys;  ///< At least one.
};

/// Without backgrounds, behind the sheets is a clutter of rectangles.
CameraPicture render(const PatternScene& scene, const Prints& prints,
                     const std::vector<vision::GrayImage>& backgrounds);

/// A mark for landing: a disc with a pole, a flag that does not touch it, and an arm.
vision::GrayImage landingMark(int side_px);
/// Shapes in several greys without a frame around them.
vision::GrayImage shapesDrawing(int side_px);
/// Things that look like the landing mark: discs with other figures, and its mirror image.
std::vector<vision::GrayImage> landingDecoys(int side_px);
vision::GrayImage mirrored(const vision::GrayImage& picture);

}  // namespace swiftlet::perception
