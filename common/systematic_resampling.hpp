// Systematic resampling, also called the low-variance sampler (Probabilistic Robotics, Table 4.4; Doucet 2000).
#pragma once

#include <cstddef>
#include <vector>

namespace swiftlet::common {

/// Replaces `chosen` by `count` indices into the weights, ascending, each count * weight / sum times,
/// rounded up or down. `sum` is that of the weights and positive; `uniform`, in [0, 1), is the one random number that
/// serves for all. There must be at least one weight.
template <typename Weight, typename Index>
void drawSystematically(const std::vector<Weight>& weights, double sum, std::size_t count, double uniform,
                        std::vector<Index>& chosen) {
  const double step = sum / static_cast<double>(count);
  double pointer = step * uniform, passed = 0.0;
  chosen.clear();
  chosen.reserve(count);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    passed += static_cast<double>(weights[i]);
    for (; pointer < passed && chosen.size() < count; pointer += step) chosen.push_back(static_cast<Index>(i));
  }
  // Rounding may leave the pointer behind the last weight.
  chosen.resize(count, static_cast<Index>(weights.size() - 1));
}

}  // namespace swiftlet::common
