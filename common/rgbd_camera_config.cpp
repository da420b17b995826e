#include "common/rgbd_camera_config.hpp"

#include <cmath>

#include "common/config_fields.hpp"
#include "common/geometry.hpp"
#include "common/pose2.hpp"
#include "common/rgbd_frame.hpp"
#include "common/validation.hpp"

namespace swiftlet::common {

void RgbdCameraConfig::describe(config::Fields& fields) {
  fields("name", name, "Name of the camera, for messages.");
  fields.choice("depth", depth, {"pattern", "stereo"},
                "Where depths come from: a projected pattern, or two pictures, in which the computer finds them.");
  fields("width_px", width_px, {16, 4096}, "Columns of a frame.");
  fields("height_px", height_px, {16, 4096}, "Rows of a frame.");
  fields("rate_hz", rate_hz, {0.1, 100}, "Frames a second.");
  fields("field_of_view_deg", field_of_view_deg, {10, 150}, "Horizontal angle of view; pixels are square.");
  fields("row_time_s", row_time_s, {0, 0.01},
         "Time from one row to the next of a rolling shutter; 0 for a global one. A frame takes at most one period.");
  fields("range_min_m", range_min_m, {0, 100}, "Least depth that is measured.");
  fields("range_max_m", range_max_m, {0.1, 100}, "Greatest depth that is measured; beyond it a pixel is too far.");
  fields("baseline_m", baseline_m, {0, 1},
         "Distance of the pattern's projector, or of the second camera, to the right of the camera. What it does not "
         "see has no depth.");
  fields("inverse_depth_noise_1_m", inverse_depth_noise_1_m, {0, 0.1},
         "Standard deviation of an inverse depth. The noise of a depth is this times the depth squared.");
  fields("inverse_depth_step_1_m", inverse_depth_step_1_m, {0, 0.1},
         "Step of the inverse depth. The step of a depth is this times the depth squared.");
  fields("depth_step_m", depth_step_m, {0, 0.1}, "Step in which depths are sent.");
  fields("right_roll_deg", right_roll_deg, {-10, 10},
         "Stereo: roll of the right camera against the left one, about its view, as calibrated.");
  fields("right_pitch_deg", right_pitch_deg, {-10, 10}, "Stereo: pitch of the right camera against the left one.");
  fields("right_yaw_deg", right_yaw_deg, {-10, 10}, "Stereo: yaw of the right camera against the left one.");
  fields("radial_k1", radial_k1, {-1, 1},
         "Stereo: what the lenses distort, by the squared tangent of the angle to the axis (Brown 1966).");
  fields("radial_k2", radial_k2, {-1, 1}, "Stereo: what the lenses distort, by the fourth power of that tangent.");
  fields.section("mount", mount, "Pose of the camera in the body frame; it looks along its +x.");
}

std::vector<Problem> RgbdCameraConfig::validate() const {
  return Validation()
      .require(row_time_s * height_px <= 1.0 / rate_hz, "row_time_s",
               Message("camera.rows-too-slow", "{} rows take more than one period of rate_hz", height_px))
      .atMost("range_min_m", range_min_m, "range_max_m", range_max_m)
      .require(!isStereo() || (baseline_m > 0.0 && range_min_m > 0.0), "depth",
               Message("camera.no-base", "a stereo camera has a baseline_m and a range_min_m above 0"))
      .problems();
}

PinholeCamera RgbdCameraConfig::camera() const {
  const double focal_px = 0.5 * width_px / std::tan(0.5 * field_of_view_deg * kRadPerDeg);
  return {width_px, height_px, focal_px, focal_px, 0.5 * (width_px - 1), 0.5 * (height_px - 1)};
}

Pose3 RgbdCameraConfig::T_left_right() const {
  return {quaternionFrom({right_roll_deg * kRadPerDeg, right_pitch_deg * kRadPerDeg, right_yaw_deg * kRadPerDeg}),
          {0.0, -baseline_m, 0.0}};
}

}  // namespace swiftlet::common
