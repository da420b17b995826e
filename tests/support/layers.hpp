// A World that a test can change: the layers as values, and snapshots of them.
#pragma once

#include <memory>
#include <vector>

#include "common/world.hpp"
#include "common/world/energy_layer.hpp"
#include "common/world/map3d_layer.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/objects_layer.hpp"
#include "common/world/people_layer.hpp"
#include "common/world/targets_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::test {

struct Layers {
  common::Time stamp;
  common::VehicleLayer vehicle;
  common::MissionLayer mission;
  common::MapLayer map;
  common::PeopleLayer people;
  common::EnergyLayer energy;
  std::shared_ptr<const common::Map3dLayer> map3d;
  common::TargetsLayer targets;
  std::shared_ptr<const common::ObjectsLayer> objects;  ///< Null: nothing is recognized.

  /// Default values, with a map in which everything is unknown.
  Layers() {
    map.grid = std::make_shared<const common::OccupancyGrid>(common::makeOccupancyGrid(0.05));
    map.flown = map.grid;
    map.levels = std::make_shared<const common::LevelMap>();
    map.frontiers = std::make_shared<const std::vector<common::Frontier>>();
  }
  explicit Layers(const common::World& world)
      : stamp(world.stamp),
        vehicle(*world.vehicle),
        mission(*world.mission),
        map(*world.map),
        people(*world.people),
        energy(*world.energy),
        map3d(world.map3d),
        targets(*world.targets),
        objects(world.objects) {}

  common::World world() const {
    return {stamp,
            std::make_shared<const common::VehicleLayer>(vehicle),
            std::make_shared<const common::MissionLayer>(mission),
            std::make_shared<const common::MapLayer>(map),
            std::make_shared<const common::PeopleLayer>(people),
            std::make_shared<const common::EnergyLayer>(energy),
            map3d,
            std::make_shared<const common::TargetsLayer>(targets),
            objects};
  }
};

}  // namespace swiftlet::test
