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
  double latency_s = 0.06;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::autonomy
