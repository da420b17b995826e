// Composes the World: one immutable snapshot after another from the states of the parts of the autonomy.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "common/world.hpp"
#include "common/world/energy_layer.hpp"
#include "common/world/map3d_layer.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/objects_layer.hpp"
#include "common/world/people_layer.hpp"
#include "common/world/targets_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::autonomy {

/// The states of the parts at one instant.
struct WorldParts {
  /// The builder itself keeps its name, its trail and the distance flown.
  common::VehicleLayer vehicle;
  common::MissionLayer mission;
  common::MapLayer map;
  common::PeopleLayer people;
  common::EnergyLayer energy;
  std::shared_ptr<const common::Map3dLayer> map3d;  ///< Null without an RGB-D camera.
  common::TargetsLayer targets;
  std::shared_ptr<const common::ObjectsLayer> objects = nullptr;  ///< Null without a recognizer.
};

/// One thread; any thread may read the snapshots.
class WorldBuilder {
 public:
  /// `vehicle_name` distinguishes the snapshots of several vehicles; empty if there is one.
  explicit WorldBuilder(std::string vehicle_name = {}) : vehicle_name_(std::move(vehicle_name)) {}

  /// The snapshot of `now`. A layer that did not change is the same object as before. The vehicle's layer is always
  /// new, because its trail and its distance grow while it is airborne.
  std::shared_ptr<const common::World> build(common::Time now, WorldParts parts);

 private:
  void follow(const common::VehicleLayer& vehicle);

  std::string vehicle_name_;
  common::TrailRecorder trail_;
  double flown_m_ = 0.0;      ///< To the anchor.
  double excursion_m_ = 0.0;  ///< How far it has been from the anchor.
  std::optional<Eigen::Vector2d> anchor_odom_m_;
  common::World last_;  ///< Its layers are null before the first snapshot.
};

}  // namespace swiftlet::autonomy
