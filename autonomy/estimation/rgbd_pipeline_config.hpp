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
  bool measure = true;
  double latency_s = 0.06;
  double wait_s = 0.05;
  Map3dPublisherConfig publisher;  ///< Its keys are on the level of the pipeline's own.
  double silent_s = 1.0;
  double lost_s = 0.5;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::autonomy
