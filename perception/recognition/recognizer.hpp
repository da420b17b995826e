// The interface of everything that recognizes known objects: what, where with covariance, how sure (Tomic 2012, section
// "Recognition": objects are identified, and their relative positions and headings estimated).
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "common/sensor_event.hpp"
#include "perception/recognition/recognized.hpp"
#include "vision/gray_image.hpp"

namespace swiftlet::perception {

/// A grey picture and the camera that took it, which has the same size.
struct CameraPicture {
  common::PinholeCamera camera;
  vision::GrayImage gray;
};

/// What the sensors show at one time; null is what they do not show. Only looked at during the call.
struct Observation {
  const CameraPicture* picture = nullptr;
  const common::LaserScan* scan = nullptr;
  const common::RgbdFrame* frame = nullptr;  ///< Of its depths; a pair of a stereo camera has none.
  /// Takes directions in the camera to axes whose z points up: the attitude at the time of the frame.
  Eigen::Quaterniond R_level_camera = Eigen::Quaterniond::Identity();
  common::Pose3 T_camera_laser = {};  ///< Of the scan that was measured about the time of the frame.
  /// In the camera: where walls are that the laser saw before and does not see now, behind it. Null: nothing is known.
  const std::vector<Eigen::Vector3d>* seen_before_m = nullptr;
};

/// Not thread-safe: a thread has its own. The same observation gives the same bits, whatever came before.
class Recognizer {
 public:
  virtual ~Recognizer() = default;
  /// The surest first. Nothing without the sensor that it needs, or for a picture of another size than its camera.
  virtual std::vector<Recognized> recognize(const Observation& observation) = 0;
};

/// Whether there is a picture that has the size of its camera.
bool hasWholePicture(const Observation& observation);
/// Whether there are depths that have the size of their camera.
bool hasWholeDepths(const Observation& observation);

}  // namespace swiftlet::perception
