// A cloud as a file holds it.
#pragma once

#include <cstddef>
#include <vector>

#include "common/submap3d.hpp"

namespace swiftlet::interfaces {

struct StoredCloud {
  std::vector<common::SurfacePoint> points;
  /// Points that were left out because their position is not finite. PCL writes such where nothing was measured.
  std::size_t not_finite = 0;
  double rounding_m = 0.0;  ///< By how much a coordinate differs at most from that of the file, which may be a double.
};

}  // namespace swiftlet::interfaces
