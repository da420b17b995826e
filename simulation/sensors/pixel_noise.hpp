// Noise of camera pixels, fast enough for every pixel of a frame.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "common/random.hpp"

namespace swiftlet::simulation {

/// Close enough to Gaussian: the sum of four bytes. One draw of the stream serves two calls.
class PixelNoise {
 public:
  PixelNoise(double standard_deviation, common::RandomStream random)
      : scale_(static_cast<float>(standard_deviation / std::sqrt(4.0 * (256.0 * 256.0 - 1.0) / 12.0))),
        random_(random) {}

  float next() {
    if (left_ == 0) bits_ = random_.bits();
    left_ = left_ == 0 ? 1 : 0;
    int sum = 0;
    for (int byte = 0; byte < 4; ++byte, bits_ >>= 8U) sum += static_cast<int>(bits_ & 0xffU);
    return scale_ * (static_cast<float>(sum) - 510.0F);
  }

 private:
  float scale_;
  common::RandomStream random_;
  std::uint64_t bits_ = 0;
  int left_ = 0;
};

inline std::uint8_t toPixelByte(float value) {
  return static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
}

}  // namespace swiftlet::simulation
