// The configuration of the multilevel filter.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::perception {

struct MultilevelConfig {
  double beam_noise_m = 0.015;
  bool one_floor = true;  ///< Whether the take-off floor may be met again anywhere, not only in the neighbourhood of
                          ///< where it was seen.

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::perception
