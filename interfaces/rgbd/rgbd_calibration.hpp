// The calibration of a recorded RGB-D camera, and frames made with it: without lens distortion, the depth registered to
// the colour image.
#pragma once

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "common/image_decoder.hpp"
#include "common/rgbd_frame.hpp"

namespace swiftlet::interfaces {

/// A lens with the distortion of Brown: k1, k2, k3 radial, p1, p2 tangential, as OpenCV names them.
struct LensCalibration {
  int width_px = 640;
  int height_px = 480;
  double fx_px = 525.0;
  double fy_px = 525.0;
  double cx_px = 319.5;
  double cy_px = 239.5;
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;

  bool isDistorted() const { return k1 != 0.0 || k2 != 0.0 || p1 != 0.0 || p2 != 0.0 || k3 != 0.0; }
  void describe(common::config::Fields& fields);
};

/// The pose of the depth camera in the colour camera. The axes of both are those of image processing: x right, y down,
/// z along the view; position in metres, rotation as a rotation vector.
struct DepthCameraPose {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double rotation_x_rad = 0.0, rotation_y_rad = 0.0, rotation_z_rad = 0.0;

  void describe(common::config::Fields& fields);
};

struct RgbdCalibration {
  LensCalibration color;
  double depth_units_per_m = 1000.0;
  /// The recorded depth is registered to the colour image. Otherwise it is that of a camera of its own.
  bool is_registered = true;
  LensCalibration depth;       ///< Only if not registered.
  DepthCameraPose depth_pose;  ///< Only if not registered.

  void describe(common::config::Fields& fields);
  /// The pose of the colour camera in the camera that the recorder's poses are of, which is the depth camera if it is
  /// not registered. Both in axes of image processing.
  common::Pose3 T_recorded_color() const;
};

/// The calibration of the benchmark's recordings when none is given: TUM's recommended one, whose depth is registered.
RgbdCalibration tumCalibration();
/// Of 7-Scenes, whose depth is not registered.
RgbdCalibration sevenScenesCalibration();

/// Whether images of that size can belong to the calibration: the same shape, at any resolution.
bool hasShapeOf(const LensCalibration& lens, int width_px, int height_px);

/// The colour image and its depth in metres, without distortion; the depth is in the colour camera's view. Both sizes
/// must have the shape of their lens. Stamps are left to the caller.
common::RgbdFrame makeFrame(const RgbdCalibration& calibration, common::Image color, const common::DepthCodes& depth);

/// The axes of image processing (x right, y down, z along the view) in the frame `camera`.
common::Pose3 T_camera_optical();

}  // namespace swiftlet::interfaces
