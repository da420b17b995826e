#include "simulation/sensors/color_sensor.hpp"

#include <algorithm>

#include "common/first_order_lag.hpp"
#include "common/random.hpp"
#include "common/row_major.hpp"
#include "simulation/sensors/pixel_noise.hpp"

namespace swiftlet::simulation {

ColorSensor::ColorSensor(const RgbdErrorsConfig& errors, double period_s, std::uint64_t seed)
    : errors_(errors), period_s_(period_s), seed_(seed) {}

common::Image ColorSensor::take(std::uint64_t number, const SeenImage& seen) {
  const std::vector<Eigen::Array4f>& light = blurred(seen);
  adjustExposure(light);
  return expose(number, seen, light);
}

common::Image ColorSensor::takeAs(const ColorSensor& leader, std::uint64_t number, const SeenImage& seen) {
  gain_ = leader.gain_;
  return expose(number, seen, blurred(seen));
}

double ColorSensor::exposure_s() const {
  const double wanted_s = errors_.exposure_s * static_cast<double>(gain_);
  return errors_.longest_exposure_s > errors_.exposure_s && gain_ > 0.0F
             ? std::min(wanted_s, errors_.longest_exposure_s)
             : errors_.exposure_s;
}

common::Image ColorSensor::expose(std::uint64_t number, const SeenImage& seen,
                                  const std::vector<Eigen::Array4f>& light) const {
  common::Image image{seen.width_px, seen.height_px, std::vector<std::uint8_t>(3 * seen.pixels())};
  // What amplifies the light amplifies the noise; a longer exposure does not.
  const double by_shutter = errors_.exposure_s > 0.0 ? exposure_s() / errors_.exposure_s : 1.0;
  const auto amplified = std::max(1.0F, gain_ / static_cast<float>(by_shutter));
  PixelNoise noise(errors_.pixel_noise * amplified, common::RandomStream(seed_, "rgbd color", number));
  std::uint8_t* byte = image.rgb.data();
  for (const Eigen::Array4f& one : light) {
    const Eigen::Array4f value = 255.0F * gain_ * one + noise.next();
    for (int channel = 0; channel < 3; ++channel) *byte++ = toPixelByte(value[channel]);
  }
  return image;
}

const std::vector<Eigen::Array4f>& ColorSensor::blurred(const SeenImage& seen) {
  if (seen.motion_px.empty()) return seen.light;
  blur(seen);
  return blurred_;
}

// The mean of the light along the motion of the surface. It takes as many samples as the motion has pixels, because
// closer ones would only be the same pixels again.
void ColorSensor::blur(const SeenImage& seen) {
  constexpr int kMostSamples = 24;
  blurred_.resize(seen.pixels());
  std::size_t pixel = 0;
  for (int v = 0; v < seen.height_px; ++v)
    for (int u = 0; u < seen.width_px; ++u, ++pixel) {
      const Eigen::Vector2f motion_px = seen.motion_px[pixel];
      const float length_px = motion_px.cwiseAbs().maxCoeff();
      const int samples = 1 + std::min(kMostSamples - 1, static_cast<int>(length_px));
      if (samples == 1) {
        blurred_[pixel] = seen.light[pixel];
        continue;
      }
      const float per_sample = 1.0F / static_cast<float>(samples);
      const Eigen::Vector2f step_px = motion_px * per_sample;
      float x = static_cast<float>(u) + 0.5F - 0.5F * (motion_px.x() - step_px.x());
      float y = static_cast<float>(v) + 0.5F - 0.5F * (motion_px.y() - step_px.y());
      Eigen::Array4f sum = Eigen::Array4f::Zero();
      for (int i = 0; i < samples; ++i, x += step_px.x(), y += step_px.y()) {
        const int column = std::clamp(static_cast<int>(x), 0, seen.width_px - 1);
        const int row = std::clamp(static_cast<int>(y), 0, seen.height_px - 1);
        sum += seen.light[common::rowMajor(row, seen.width_px, column)];
      }
      blurred_[pixel] = sum * per_sample;
    }
}

void ColorSensor::adjustExposure(const std::vector<Eigen::Array4f>& light) {
  if (errors_.exposure_lag_s <= 0.0) {
    gain_ = 1.0F;
    return;
  }
  constexpr float kMiddleGrey = 0.45F, kLeastGain = 0.25F, kMostGain = 8.0F;
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  constexpr std::size_t kEvery = 7;  // Enough pixels for a mean.
  std::size_t count = 0;
  for (std::size_t i = 0; i < light.size(); i += kEvery, ++count) sum += light[i];
  const float mean = sum.head<3>().sum() / static_cast<float>(3 * count);
  // Until the shutter is open for longest, nothing is amplified.
  const auto by_shutter = static_cast<float>(
      errors_.exposure_s > 0.0 ? std::max(1.0, errors_.longest_exposure_s / errors_.exposure_s) : 1.0);
  const float wanted = std::clamp(kMiddleGrey / std::max(mean, 1e-3F), kLeastGain, kMostGain * by_shutter);
  const auto share = static_cast<float>(common::followedShare(period_s_, errors_.exposure_lag_s));
  gain_ = gain_ == 0.0F ? wanted : gain_ + share * (wanted - gain_);
}

}  // namespace swiftlet::simulation
