// Windows and doors as recognized objects: in depth images `window` and `door`, with what is known of their height, and
// in scans `opening`, of which only the place and width in the plane of the laser are known (Tomic 2012, section
// "Recognition": the laser detects corners, walls and windows; the image the window's frame).
//
//   depth --> walls --> holes with the wall around --> room behind? a reflection? --> window | door, open | closed
//   scan --> lines --> two of one wall with a gap through which the laser sees --> opening
//
// A picture of a window is a wall; where the scan shows what it reflects, it is a `mirror`. Frames: x along the
// wall's normal towards the sensor, z up, the origin in the middle of the hole in the plane of the wall.
#pragma once

#include <vector>

#include "perception/recognition/recognizer.hpp"
#include "perception/recognition/scan_lines.hpp"

namespace swiftlet::perception {

struct OpeningConfig {
  double inverse_depth_sigma_1_m = 0.00165;  ///< Of a pixel, noise and steps together; by the camera's data sheet.
  double range_max_m = 5.0;                  ///< Of the camera.
  ScanLineConfig lines{.length_min_m = 0.2};
};

/// Openings with more confidence than this have been told from mirrors by a scan, or there was none.
inline constexpr double kSureOpening = 0.5;

/// Openings in the depths of a frame. A scan of the same time, if there is one, tells mirrors and panes.
class OpeningRecognizer final : public Recognizer {
 public:
  explicit OpeningRecognizer(const OpeningConfig& config) : config_(config) {}

  std::vector<Recognized> recognize(const Observation& observation) override;

 private:
  OpeningConfig config_;
};

/// Openings in a scan.
class ScanOpeningRecognizer final : public Recognizer {
 public:
  explicit ScanOpeningRecognizer(const OpeningConfig& config) : config_(config) {}

  std::vector<Recognized> recognize(const Observation& observation) override;

 private:
  OpeningConfig config_;
};

}  // namespace swiftlet::perception
