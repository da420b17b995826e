// The colour image that a sensor makes of the light it sees: blur of motion, exposure control, noise.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image.hpp"
#include "simulation/sensors/seen_image.hpp"
#include "simulation/sensors/sensor_config.hpp"

namespace swiftlet::simulation {

class ColorSensor {
 public:
  /// `period_s` is the time between two frames.
  ColorSensor(const RgbdErrorsConfig& errors, double period_s, std::uint64_t seed);

  /// Call it for each frame in its turn: the exposure of a frame follows from those before it.
  common::Image take(std::uint64_t number, const SeenImage& seen);
  /// The picture of a second sensor that is exposed as the leader was for its last one.
  common::Image takeAs(const ColorSensor& leader, std::uint64_t number, const SeenImage& seen);

  /// How long the shutter is open for the next frame. In the dark it is open longer, before the light is amplified.
  double exposure_s() const;

 private:
  common::Image expose(std::uint64_t number, const SeenImage& seen, const std::vector<Eigen::Array4f>& light) const;
  const std::vector<Eigen::Array4f>& blurred(const SeenImage& seen);
  void blur(const SeenImage& seen);
  void adjustExposure(const std::vector<Eigen::Array4f>& light);

  RgbdErrorsConfig errors_;
  double period_s_;
  std::uint64_t seed_;
  float gain_ = 0.0F;                    ///< On the light, by shutter and amplifier; 0 before the first frame.
  std::vector<Eigen::Array4f> blurred_;  ///< Kept between frames to save the allocation.
};

}  // namespace swiftlet::simulation
