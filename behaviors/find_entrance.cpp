// FindEntrance: explores outside until an open door is confirmed behind which there is room, and chooses a place inside
// (Saeedi et al., section IV-B: "the robot chooses a traversable goal point inside the building"). It does not enter.
// SUCCESS with the place; FAILURE when exploring ends before.
//
//   explore --an open door--> stop --> a free place inside is in sight? --> SUCCESS
//      ^                                 |  no
//      |                                 v
//      +--- nothing there either --- look from before the door
#include "behaviors/leaves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "behaviors/explore_ports.hpp"
#include "behaviors/flight_leaf.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/openings.hpp"
#include "behaviors/ports.hpp"
#include "common/line_of_sight.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

using common::IntentState;
using common::RecognizedObject;
using tree::PortType;
using tree::Status;

/// The least depth of a place that is inside: behind the reveal of a wall, with the whole hull.
constexpr double kLeastInside_m = 0.8;
/// Places are compared on a grid of this size.
constexpr double kStep_m = 0.2;
/// Besides the clearance asked for: the place is to stay free when more of the room is seen.
constexpr double kRoom_m = 0.1;
/// Within this angle of the door's normal places inside are in sight from before it.
constexpr double kTanAside = 1.0;
/// Where it looks in from, before the door, and for how long.
constexpr double kBefore_m = 1.2, kLooks_s = 1.5, kBeforeTolerance_m = 0.3;
constexpr double kDoorPost_m = 0.1;  ///< Cells this near to the middle of the door are the door's own.

/// Horizontal, into the building.
Eigen::Vector2d inwardOf(const RecognizedObject& door) {
  const Eigen::Vector3d normal_map = door.T_map_object.rotation * Eigen::Vector3d::UnitX();
  return -normal_map.head<2>().normalized();
}

Eigen::Vector2d middleOf(const RecognizedObject& door) { return door.T_map_object.position_m.head<2>(); }

class FindEntrance final : public FlightLeaf {
 public:
  explicit FindEntrance(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  /// Where it looks into a door from.
  struct Look {
    int door_id = 0;
    common::GoToIntent from;
    std::optional<common::Time> since = std::nullopt;  ///< When it was there.
  };

  void onStart(tree::TickContext& context) override;
  void onResume(tree::TickContext& context) override;
  Status act(tree::TickContext& context) override;
  Status explore(tree::TickContext& context, const common::ExploreIntent& intent);
  Status enterBy(tree::TickContext& context, const RecognizedObject& door, const Eigen::Vector2d& inside_map_m);
  void look(FlightTick& tick, const RecognizedObject& door, const common::ExploreIntent& intent);
  /// Those that may lead inside and were not tried, the nearest first.
  ObjectPointers doorsFrom(const FlightTick& tick, const common::ExploreIntent& intent) const;
  bool isTried(int door_id) const { return std::find(tried_.begin(), tried_.end(), door_id) != tried_.end(); }

  ExplorePorts ports_;
  tree::Input<double> depth_m_;
  tree::Output door_, place_;

  std::vector<int> tried_;  ///< Ids of doors behind which no place was found.
  std::optional<Look> look_;
  bool explored_ = false;
};

tree::NodeManifest FindEntrance::manifest() {
  tree::NodeManifest manifest{
      .id = "FindEntrance",
      .kind = tree::NodeKind::kAction,
      .ports = {{.name = "depth_m",
                 .type = PortType::kDouble,
                 .default_value = "3.0",
                 .minimum = kLeastInside_m,
                 .maximum = 30.0,
                 .description = "Greatest distance of the place inside from the wall with the door."},
                {.name = "door",
                 .type = PortType::kPoint,
                 .direction = tree::Direction::kOutput,
                 .description = "Middle of the door, in the given map in a flight with one."},
                {.name = "place",
                 .type = PortType::kPoint,
                 .direction = tree::Direction::kOutput,
                 .description = "The place inside: the deepest that is free and in sight through the door."}},
      .description = "Explores until an open door is found, and chooses a place behind it.",
      .details =
          "The door is a confirmed opening that is not a window and that the hull fits through, seen from outside; the "
          "nearest comes first. Where no place behind it is in sight, it looks in from before it. The profile must "
          "recognize openings. Fly in by `MoveToGoal goal=\"{place}\"`, and out by `GoHome`.",
      .ends = "SUCCESS with a place inside, and the vehicle has stopped; FAILURE when everything is explored before"};
  for (tree::PortManifest& port : ExplorePorts::manifests()) manifest.ports.push_back(std::move(port));
  return manifest;
}

FindEntrance::FindEntrance(const tree::NodeSetup& setup)
    : FlightLeaf(setup), ports_(setup), depth_m_(setup, "depth_m"), door_(setup, "door"), place_(setup, "place") {}

void FindEntrance::onStart(tree::TickContext& context) {
  FlightLeaf::onStart(context);
  tried_.clear();
  look_.reset();
  explored_ = false;
}

void FindEntrance::onResume(tree::TickContext& context) {
  FlightLeaf::onResume(context);
  if (look_) look_->since.reset();
}

/// The deepest free place behind the door that is in sight through it; of several the one nearest to its normal.
std::optional<Eigen::Vector2d> placeInside(const FlightTick& tick, const RecognizedObject& door, double depth_m,
                                           double clearance_m) {
  const auto& map = tick.flight.goal_map;
  if (!map) return std::nullopt;
  const common::OccupancyGrid& grid = *tick.flight.world->map->grid;
  const Eigen::Vector2d middle_map_m = middleOf(door), inward = inwardOf(door), aside(-inward.y(), inward.x());
  for (double deep_m = depth_m; deep_m > kLeastInside_m - 1e-9; deep_m -= kStep_m) {
    for (int i = 0; i * kStep_m <= kTanAside * deep_m; ++i) {
      for (const double side : {1.0, -1.0}) {
        const Eigen::Vector2d place_map_m = middle_map_m + deep_m * inward + side * i * kStep_m * aside;
        if (map->stateAt(place_map_m, clearance_m + kRoom_m) != common::PlaceState::kFree) continue;
        if (common::isInSight(grid, place_map_m, middle_map_m, kDoorPost_m)) return place_map_m;
      }
    }
  }
  return std::nullopt;
}

/// An open one that the hull fits through, seen from where the vehicle is.
bool leadsInside(const FlightTick& tick, const RecognizedObject& object, double clearance_m) {
  if (!isOpenFor(object, 0.0)) return false;
  const Eigen::Vector2d here_map_m = tick.flight.world->vehicle->state.T_map_body_planar().position_m();
  if (inwardOf(object).dot(middleOf(object) - here_map_m) <= 0.0) return false;
  const auto& map = tick.flight.goal_map;
  return !map || map->stateAt(middleOf(object), clearance_m) == common::PlaceState::kFree;
}

ObjectPointers FindEntrance::doorsFrom(const FlightTick& tick, const common::ExploreIntent& intent) const {
  const common::World& world = *tick.flight.world;
  const Eigen::Vector2d here_map_m = world.vehicle->state.T_map_body_planar().position_m();
  ObjectPointers doors;
  for (const char* what : {"door", "opening"})
    for (const RecognizedObject* object :
         objectsNear(world, what, here_map_m, std::numeric_limits<double>::infinity())) {
      const bool inside = !intent.bounds || intent.bounds->contains(middleOf(*object));
      if (inside && !isTried(object->id) && leadsInside(tick, *object, intent.clearance_m)) doors.push_back(object);
    }
  std::stable_sort(doors.begin(), doors.end(), [&](const RecognizedObject* a, const RecognizedObject* b) {
    return (middleOf(*a) - here_map_m).norm() < (middleOf(*b) - here_map_m).norm();
  });
  return doors;
}

Status FindEntrance::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  const common::World& world = *tick.flight.world;
  const auto intent = ports_.intent(tick.mode, world);
  const auto depth_m = depth_m_.get();
  if (!intent) return fail(context, intent.error());
  if (!depth_m) return fail(context, depth_m_.problem());
  if (!world.objects) return fail(context, "the profile recognizes no openings");
  const ObjectPointers doors = doorsFrom(tick, *intent);
  for (const RecognizedObject* door : doors)
    if (const auto inside_map_m = placeInside(tick, *door, *depth_m, intent->clearance_m))
      return enterBy(context, *door, *inside_map_m);
  if (look_ && isTried(look_->door_id)) look_.reset();
  if (!look_ && doors.empty()) return explore(context, *intent);
  const RecognizedObject* door = look_ ? objectWithId(world, look_->door_id) : doors.front();
  if (door == nullptr) {  // It was joined with another one meanwhile.
    look_.reset();
    renewIntent();
    return Status::kRunning;
  }
  look(tick, *door, *intent);
  return Status::kRunning;
}

Status FindEntrance::explore(tree::TickContext& context, const common::ExploreIntent& intent) {
  FlightTick& tick = flightTick(context);
  if (explored_) return fail(context, "no entrance was found");
  emitIntent(tick, intent);
  if (intentState(tick) == IntentState::kFailed)
    return fail(context, "no entrance was found: " + tick.flight.status.reason);
  explored_ = intentState(tick) == IntentState::kSucceeded;
  return Status::kRunning;
}

/// From before the door the laser sees more of the room behind it.
void FindEntrance::look(FlightTick& tick, const RecognizedObject& door, const common::ExploreIntent& intent) {
  if (!look_) {
    const Eigen::Vector2d inward = inwardOf(door);
    look_ = Look{door.id, {}};
    look_->from.goal_map_m = middleOf(door) - kBefore_m * inward;
    look_->from.yaw_map_rad = std::atan2(inward.y(), inward.x());
    look_->from.tolerance_m = look_->from.shift_m = kBeforeTolerance_m;
    look_->from.clearance_m = intent.clearance_m;
    look_->from.mode = intent.mode;
    renewIntent();
  }
  if (look_->since) {
    emitHold(tick);
    if ((tick.flight.now - *look_->since).seconds() < kLooks_s) return;
  } else {
    emitIntent(tick, look_->from);
    if (intentState(tick) == IntentState::kSucceeded) look_->since = tick.flight.now;
    if (intentState(tick) != IntentState::kFailed) return;
  }
  tick.say(common::Severity::kInfo,
           "no place is free behind " + door.what + " at " + tick.flight.world->map->names().of(middleOf(door)), {});
  tried_.push_back(look_->door_id);
  look_.reset();
  renewIntent();
}

Status FindEntrance::enterBy(tree::TickContext& context, const RecognizedObject& door,
                             const Eigen::Vector2d& inside_map_m) {
  FlightTick& tick = flightTick(context);
  emitHold(tick);
  if (!holdReleased(tick)) return Status::kRunning;
  const auto places = NamedPlaces::in(*tick.flight.world);
  if (!places) return fail(context, places.error());
  const common::PlaceNames names = tick.flight.world->map->names();
  tick.say(common::Severity::kInfo, "an entrance",
           fmt::format("{:.2f} m wide at {}, the place inside is {}", door.size_m.x(), names.of(middleOf(door)),
                       names.of(inside_map_m)));
  door_.set(places->point(middleOf(door)));
  place_.set(places->point(inside_map_m));
  return Status::kSuccess;
}

}  // namespace

void addFindEntrance(tree::Registry& registry) { registry.add<FindEntrance>(); }

}  // namespace swiftlet::behaviors
