// The world as the autonomy knows it at one instant: an immutable snapshot in layers, read by behaviours, the page and
// the files. A reader includes the header of each layer it reads (common/world/). A layer that did not change is shared
// with the previous snapshot, so equal pointers mean equal layers. Safe to read from any thread.
#pragma once

#include <memory>

#include "common/time.hpp"

namespace swiftlet::common {

struct VehicleLayer;
struct MissionLayer;
struct MapLayer;
struct PeopleLayer;
struct EnergyLayer;
struct Map3dLayer;
struct TargetsLayer;
struct ObjectsLayer;

/// Only `map3d` and `objects` are ever null in a World that the autonomy made.
struct World {
  Time stamp;
  std::shared_ptr<const VehicleLayer> vehicle;
  std::shared_ptr<const MissionLayer> mission;
  std::shared_ptr<const MapLayer> map;
  std::shared_ptr<const PeopleLayer> people;
  std::shared_ptr<const EnergyLayer> energy;
  std::shared_ptr<const Map3dLayer> map3d;  ///< Null without an RGB-D camera or an upright laser.
  std::shared_ptr<const TargetsLayer> targets;
  std::shared_ptr<const ObjectsLayer> objects;  ///< Null without a recognizer.
};

}  // namespace swiftlet::common
