// How surfaces are kept in submaps.
#pragma once

#include "common/config_fwd.hpp"

namespace swiftlet::mapping3d {

struct SubmapConfig {
  double cube_m = 0.02;
  double point_range_m = 5.0;
  double reach_m = 2.5;
  int points_max = 4'000'000;
  int submaps_max = 200;
  int blocks_max = 500'000;

  void describe(common::config::Fields& fields);
};

/// Of submaps from depth images, which have far more pixels than a map needs points.
struct ImageSubmapConfig : SubmapConfig {
  int pixel_step = 2;
  int frame_step = 3;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::mapping3d
