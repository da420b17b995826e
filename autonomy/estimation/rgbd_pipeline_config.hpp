// The settings of 3D mapping in flight.
#pragma once

#include "autonomy/estimation/map3d_publisher.hpp"
#include "common/config_fwd.hpp"
#include "mapping3d/link/radio_link.hpp"
#include "mapping3d/model/mapper3d.hpp"
#include "mapping3d/odometry/camera_calibration.hpp"

namespace swiftlet::autonomy {

struct RgbdPipelineConfig {
  mapping3d::Mapper3dConfig mapper;
  mapping3d::RadioLinkConfig radio;
  mapping3d::CameraCalibrationConfig calibration;
  static constexpr bool measure = true;  ///< Whether the poses of frames are measurements for the filter.
  double latency_s = 0.06;
  static constexpr double wait_s = 0.05;   ///< Greatest wait of a frame for a scan that is not older.
  Map3dPublisherConfig publisher;          ///< Its keys are at this level of the file.
  static constexpr double silent_s = 1.0;  ///< A camera that sends no usable frame for this long is silent.
  static constexpr double lost_s = 0.5;    ///< The track counts as lost when no frame has fitted for this long.

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::autonomy
