// Random streams, each identified by (seed, name, frame) and never shared. The draws of one sensor do not change those
// of another, and frame 812 of the laser draws the same numbers whether or not frame 811 was computed.
#pragma once

#include <cstdint>
#include <string_view>

namespace swiftlet::common {

/// A small generator (SplitMix64) with the distributions that the simulator needs, equal on every machine.
/// Not thread-safe. Make one for each use: construction costs a few nanoseconds.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name, std::uint64_t frame = 0);

  std::uint64_t bits();
  /// Uniform in [0, 1).
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Gaussian by the polar method; mean 0, standard deviation 1.
  double gaussian();
  double gaussian(double standard_deviation) { return standard_deviation * gaussian(); }
  /// True with the given probability.
  bool chance(double probability) { return uniform() < probability; }

 private:
  std::uint64_t state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace swiftlet::common
