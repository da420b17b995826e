// Conditions: leaves that ask the World and answer in the same tick. SUCCESS: it is so. FAILURE: it is not, or it is
// not known; the reason says which.
#include "behaviors/leaves.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "behaviors/flight_tick.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/ports.hpp"
#include "behaviors/target_ports.hpp"
#include "behaviors/tree/leaf.hpp"
#include "common/world.hpp"
#include "common/world/energy_layer.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/people_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

using tree::NodeKind;
using tree::PortType;

class Condition : public tree::Leaf {
 public:
  using Leaf::Leaf;

 protected:
  /// Why it is not so; empty if it is.
  virtual std::string objection(const FlightTick& tick) const = 0;

 private:
  tree::Status act(tree::TickContext& context) final;
};

/// The battery has at most `share` of its charge left.
class IsBatteryLow final : public Condition {
 public:
  explicit IsBatteryLow(const tree::NodeSetup& setup) : Condition(setup), share_(setup, "share") {}
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
  tree::Input<double> share_;
};

/// The charge suffices to fly home and land, with `reserve_share` to spare.
class IsHomeReachable final : public Condition {
 public:
  explicit IsHomeReachable(const tree::NodeSetup& setup) : Condition(setup), reserve_share_(setup, "reserve_share") {}
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
  tree::Input<double> reserve_share_;
};

/// The position is unknown, or has drifted by more than `drift_m` since the laser last fixed it in every direction.
class IsLost final : public Condition {
 public:
  explicit IsLost(const tree::NodeSetup& setup) : Condition(setup), drift_m_(setup, "drift_m") {}
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
  tree::Input<double> drift_m_;
};

/// The operator holds the mission, or an emergency does.
class IsOperatorHolding final : public Condition {
 public:
  using Condition::Condition;
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
};

/// A person is nearer to the vehicle's centre than `distance_m`.
class IsPersonNear final : public Condition {
 public:
  explicit IsPersonNear(const tree::NodeSetup& setup) : Condition(setup), distance_m_(setup, "distance_m") {}
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
  tree::Input<double> distance_m_;
};

/// Explore has left no frontier open, nor blocked for a time.
class IsExplored final : public Condition {
 public:
  using Condition::Condition;
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
};

/// The vehicle is within `tolerance_m` of `place`, and of its height if the place has one.
class IsAt final : public Condition {
 public:
  explicit IsAt(const tree::NodeSetup& setup)
      : Condition(setup), place_(setup, "place"), tolerance_m_(setup, "tolerance_m") {}
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
  tree::Input<tree::Point> place_;
  tree::Input<double> tolerance_m_;
};

/// At least `count` targets of that name are found.
class IsTargetFound final : public Condition {
 public:
  explicit IsTargetFound(const tree::NodeSetup& setup)
      : Condition(setup), name_(setup, "target"), count_(setup, "count") {}
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
  tree::Input<std::string> name_;
  tree::Input<std::int64_t> count_;
};

tree::Status Condition::act(tree::TickContext& context) {
  const std::string why_not = objection(flightTick(context));
  return why_not.empty() ? tree::Status::kSuccess : fail(context, why_not);
}

tree::NodeManifest IsBatteryLow::manifest() {
  return {.id = "IsBatteryLow",
          .kind = NodeKind::kCondition,
          .ports = {{.name = "share",
                     .type = PortType::kDouble,
                     .default_value = "0.30",
                     .minimum = 0.0,
                     .maximum = 1.0,
                     .description = "Charge, as a share of the full battery."}},
          .description = "The battery has at most this charge left.",
          .ends = "at once"};
}

std::string IsBatteryLow::objection(const FlightTick& tick) const {
  const auto share = share_.get();
  if (!share) return share_.problem();
  const double left = tick.flight.world->energy->battery_remaining;
  return left <= *share ? std::string() : fmt::format("{:.0f} % of the battery left", 100.0 * left);
}

tree::NodeManifest IsHomeReachable::manifest() {
  return {.id = "IsHomeReachable",
          .kind = NodeKind::kCondition,
          .ports = {{.name = "reserve_share",
                     .type = PortType::kDouble,
                     .default_value = "0.05",
                     .minimum = 0.0,
                     .maximum = 1.0,
                     .description = "Charge to spare, as a share of the full battery."}},
          .description = "The charge suffices to fly home and land.",
          .ends = "at once"};
}

std::string IsHomeReachable::objection(const FlightTick& tick) const {
  const auto reserve_share = reserve_share_.get();
  if (!reserve_share) return reserve_share_.problem();
  const common::EnergyLayer& energy = *tick.flight.world->energy;
  if (!energy.home_share) return "the consumption is not known yet";
  const double left = energy.battery_remaining - energy.land_share - *reserve_share;
  if (left >= *energy.home_share) return {};
  return fmt::format("home takes {:.0f} % of the battery, {:.0f} % are left for it", 100.0 * *energy.home_share,
                     100.0 * std::max(0.0, left));
}

tree::NodeManifest IsLost::manifest() {
  return {.id = "IsLost",
          .kind = NodeKind::kCondition,
          .ports = {{.name = "drift_m",
                     .type = PortType::kDouble,
                     .default_value = "0.50",
                     .minimum = 0.0,
                     .maximum = 100.0,
                     .description = "Standard deviation of the position from which on it counts as lost."}},
          .description = "The vehicle does not know where it is.",
          .details = "The position is unknown, or has drifted further than that.",
          .ends = "at once"};
}

std::string IsLost::objection(const FlightTick& tick) const {
  const auto drift_m = drift_m_.get();
  if (!drift_m) return drift_m_.problem();
  const common::World& world = *tick.flight.world;
  if (!world.vehicle->state.horizontal_valid || world.vehicle->drift_m > *drift_m) return {};
  const auto& localization = world.map->localization;
  if (localization && localization->state == common::LocalizationState::kLost) return {};
  return fmt::format("the position is known to {:.2f} m", world.vehicle->drift_m);
}

tree::NodeManifest IsOperatorHolding::manifest() {
  return {.id = "IsOperatorHolding",
          .kind = NodeKind::kCondition,
          .description = "The operator holds the mission, or an emergency does.",
          .ends = "at once"};
}

std::string IsOperatorHolding::objection(const FlightTick& tick) const {
  return tick.flight.hold ? std::string() : "nobody holds";
}

tree::NodeManifest IsPersonNear::manifest() {
  return {.id = "IsPersonNear",
          .kind = NodeKind::kCondition,
          .ports = {{.name = "distance_m",
                     .type = PortType::kDouble,
                     .default_value = "2.0",
                     .minimum = 0.0,
                     .maximum = 30.0,
                     .description = "Distance from the vehicle's centre to the edge of the person."}},
          .description = "The laser sees a moving person near the vehicle.",
          .ends = "at once"};
}

std::string IsPersonNear::objection(const FlightTick& tick) const {
  const auto distance_m = distance_m_.get();
  if (!distance_m) return distance_m_.problem();
  const common::World& world = *tick.flight.world;
  const Eigen::Vector2d here_map_m = world.vehicle->state.T_map_body_planar().position_m();
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const common::Disc& person : world.people->people)
    nearest_m = std::min(nearest_m, (person.center_map_m - here_map_m).norm() - person.radius_m);
  if (nearest_m < *distance_m) return {};
  return std::isfinite(nearest_m) ? fmt::format("the nearest person is {:.1f} m away", nearest_m) : "nobody is seen";
}

tree::NodeManifest IsExplored::manifest() {
  return {.id = "IsExplored",
          .kind = NodeKind::kCondition,
          .description =
              "Explore has left no frontier open, nor blocked for a time: every remaining one has another reason.",
          .ends = "at once"};
}

std::string IsExplored::objection(const FlightTick& tick) const {
  const common::MapLayer& map = *tick.flight.world->map;
  if (!(map.explored_area_m2 > 0.0)) return "nothing has been explored yet";
  for (const common::FrontierReason reason : {common::FrontierReason::kOpen, common::FrontierReason::kBlocked}) {
    const auto count = std::count_if(map.frontiers->begin(), map.frontiers->end(),
                                     [&](const common::Frontier& frontier) { return frontier.reason == reason; });
    if (count > 0)
      return fmt::format("{} {} {}", count, count == 1 ? "frontier is" : "frontiers are", toString(reason));
  }
  return {};
}

tree::NodeManifest IsAt::manifest() {
  return {.id = "IsAt",
          .kind = NodeKind::kCondition,
          .ports = {placePort("place"),
                    {.name = "tolerance_m",
                     .type = PortType::kDouble,
                     .default_value = "0.30",
                     .minimum = 0.01,
                     .maximum = 100.0,
                     .description = "Greatest horizontal distance, and greatest difference in height."}},
          .description = "The vehicle is near a place.",
          .ends = "at once"};
}

std::string IsAt::objection(const FlightTick& tick) const {
  const auto place = place_.get();
  const auto tolerance_m = tolerance_m_.get();
  if (!place) return place_.problem();
  if (!tolerance_m) return tolerance_m_.problem();
  const common::VehicleState& state = tick.flight.world->vehicle->state;
  if (!state.horizontal_valid) return "the position is not known";
  const auto places = NamedPlaces::in(*tick.flight.world);
  if (!places) return places.error();
  const Eigen::Vector3d here_map_m = state.T_map_body().position_m;
  const double distance_m = (here_map_m.head<2>() - places->inMap_m(*place)).norm();
  if (distance_m > *tolerance_m) return fmt::format("it is {:.2f} m away", distance_m);
  const double above_m = place->z ? here_map_m.z() - *place->z : 0.0;
  return std::abs(above_m) <= *tolerance_m ? std::string()
                                           : fmt::format("it is {:.2f} m higher or lower", std::abs(above_m));
}

tree::NodeManifest IsTargetFound::manifest() {
  return {.id = "IsTargetFound",
          .kind = NodeKind::kCondition,
          .ports = {targetNamePort(), targetCountPort()},
          .description = "The camera has found targets.",
          .details = "That many of that name, each seen from enough places.",
          .ends = "at once",
          .traits = LeafTraits{.needs_camera = true, .about_targets = true}};
}

std::string IsTargetFound::objection(const FlightTick& tick) const {
  const auto name = name_.get();
  const auto count = count_.get();
  if (!name) return name_.problem();
  if (!count) return count_.problem();
  const std::int64_t found = countFound(*tick.flight.world->targets, *name);
  return found >= *count ? std::string() : foundText(found, *count, *name);
}

}  // namespace

void addFlightConditions(tree::Registry& registry) {
  registry.add<IsBatteryLow>();
  registry.add<IsHomeReachable>();
  registry.add<IsLost>();
  registry.add<IsOperatorHolding>();
  registry.add<IsPersonNear>();
  registry.add<IsExplored>();
  registry.add<IsAt>();
  registry.add<IsTargetFound>();
}

}  // namespace swiftlet::behaviors
