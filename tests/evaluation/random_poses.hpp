// Poses that rapidcheck draws, for properties.
#pragma once

#include <rapidcheck.h>

#include "common/geometry.hpp"

namespace swiftlet::test {

inline double draw(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1'000'001) * 1e-6; }

/// Within a cube of twice that size about the origin, rotated anyhow.
inline common::Pose3 drawPose(double size_m) {
  const double x = draw(-1, 1), y = draw(-1, 1), z = draw(-3, 3);
  const double x_m = draw(-size_m, size_m), y_m = draw(-size_m, size_m), z_m = draw(-size_m, size_m);
  return {common::expSO3({x, y, z}), {x_m, y_m, z_m}};
}

}  // namespace swiftlet::test
