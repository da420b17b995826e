// Whether the map of a recorded camera is probably right.
#pragma once

#include <string>

#include "apps/map3d_run.hpp"
#include "mapping3d/model/map_contradiction.hpp"

namespace swiftlet::apps {

struct Map3dTrust {
  std::string reason;            ///< Why the map is probably wrong; empty if nothing says so.
  bool is_much_missing = false;  ///< Too few frames have a pose in the map.
  mapping3d::MapContradiction contradiction;
};

/// Once all frames are mapped, in those pieces.
Map3dTrust map3dTrust(Map3dRun& run, const std::vector<MapPiece>& pieces);

}  // namespace swiftlet::apps
