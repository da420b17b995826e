// The interface of everything that recognizes known objects: what, where with covariance, how sure (Tomic 2012, section
// "Recognition": objects are identified, and their relative positions and headings estimated).
#pragma once

#include <vector>

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

}  // namespace swiftlet::perception
