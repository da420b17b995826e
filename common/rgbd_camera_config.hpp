// The data sheet of an RGB-D camera, known to both the autonomy and the simulator. It is loaded from config/sensors.
// How a real camera differs from its data sheet is in simulation/.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::common {

struct PinholeCamera;
struct Pose3;

/// What depths come from: the disparity of a projected pattern, measured in the camera, or that of two pictures, which
/// the computer measures (vision/stereo_matcher).
enum class DepthMethod { kPattern, kStereo };

/// A camera that measures depth by disparity. Disparity is proportional to the inverse depth, so its steps and its
/// noise are given as inverse depths, which hold for every image size. A stereo camera has two equal cameras; its left
/// one is the one that is mounted.
struct RgbdCameraConfig {
  std::string name = "xtion";
  DepthMethod depth = DepthMethod::kPattern;
  int width_px = 320;
  int height_px = 240;
  double rate_hz = 15.0;
  double field_of_view_deg = 58.0;
  double row_time_s = 0.0;
  double range_min_m = 0.8;
  double range_max_m = 5.0;
  double baseline_m = 0.075;
  double inverse_depth_noise_1_m = 0.0014;
  double inverse_depth_step_1_m = 0.0028;
  double depth_step_m = 0.001;
  // Of a stereo camera, by its calibration.
  double right_roll_deg = 0.0;
  double right_pitch_deg = 0.0;
  double right_yaw_deg = 0.0;
  double radial_k1 = 0.0;
  double radial_k2 = 0.0;
  MountConfig mount{.x_m = 0.1, .z_m = 0.05};  ///< T_body_camera; it looks along its +x.

  void describe(config::Fields& fields);
  std::vector<Problem> validate() const;

  /// Square pixels, and the optical axis through the middle of the image.
  PinholeCamera camera() const;
  bool isStereo() const { return depth == DepthMethod::kStereo; }
  /// The right camera of a stereo camera in the left one.
  Pose3 T_left_right() const;
};

}  // namespace swiftlet::common
