// LeaveByDoor: to a place outside, through a door (Tomic 2012, Fig. 4, the fall-back of leaving by the window). SUCCESS
// outside. The way is planned in the map, so a door that is closed in it is not flown through.
//
//   an open door is confirmed near its stored place --> to a place behind it --> to the place outside --> SUCCESS
//       ^ recognized on the way                                                       ^
//   none is: to the stored place of the door, from where the laser sees outside ------+
#include "behaviors/leaves.hpp"

#include <optional>
#include <string>

#include <fmt/format.h>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/openings.hpp"
#include "behaviors/ports.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

using tree::PortType;
using tree::Status;

constexpr double kDoorTolerance_m = 0.3;  ///< Places on the way.
/// From a recognized door to the place behind it: the hull is out of the wall, and the laser sees around.
constexpr double kBehindDoor_m = 1.0;
/// A stored place may lie in the wall beside the door, or in unknown space.
constexpr double kStoredShift_m = 0.8;

class LeaveByDoor final : public FlightLeaf {
 public:
  explicit LeaveByDoor(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  struct Ports {
    Eigen::Vector2d door_map_m, outside_map_m;
    double within_m, width_m, tolerance_m, clearance_m;
    common::FlightMode mode;
  };
  enum class Leg { kToDoor, kBehindDoor, kOutside };

  void onStart(tree::TickContext& context) override;
  Status act(tree::TickContext& context) override;
  tl::expected<Ports, std::string> ports(const FlightTick& tick) const;
  /// Chooses the first leg, or that behind a door that was recognized meanwhile.
  void chooseDoor(FlightTick& tick, const Ports& ports);
  void begin(Leg leg, const Eigen::Vector2d& goal_map_m, double tolerance_m, double shift_m, const Ports& ports);

  tree::Input<tree::Point> door_, outside_;
  tree::Input<double> within_m_, width_m_, tolerance_m_, clearance_m_;
  tree::Input<std::string> mode_;

  std::optional<Leg> leg_;
  common::GoToIntent intent_;
  std::string why_not_door_;  ///< Why the stored place of the door was not reached; empty if it was.
};

tree::NodeManifest LeaveByDoor::manifest() {
  tree::PortManifest door = placePort("door"), outside = placePort("outside");
  door.description = "Where the door is stored. " + door.description;
  outside.description = "A place outside, where it ends. " + outside.description;
  return {.id = "LeaveByDoor",
          .kind = tree::NodeKind::kAction,
          .ports = {std::move(door),
                    std::move(outside),
                    {.name = "within_m",
                     .type = PortType::kDouble,
                     .default_value = "1.5",
                     .minimum = 0.1,
                     .maximum = 100.0,
                     .description = "How far a recognized door may be from its stored place."},
                    {.name = "width_m",
                     .type = PortType::kDouble,
                     .default_value = "0.75",
                     .minimum = 0.1,
                     .maximum = 10.0,
                     .description = "Least width of a recognized door: that of the hull, and 10 cm at each side."},
                    {.name = "tolerance_m",
                     .type = PortType::kDouble,
                     .default_value = "0.2",
                     .minimum = 0.01,
                     .maximum = 5.0,
                     .description = "Arrived when nearer to the place outside than this."},
                    clearancePort(),
                    modePort()},
          .description = "Leaves a house by its door.",
          .details =
              "Through the nearest open door that is recognized near the stored place; without one to the stored place "
              "itself, and on from there. All ways are planned in the map.",
          .ends = "SUCCESS at the place outside; FAILURE when no path leads there"};
}

LeaveByDoor::LeaveByDoor(const tree::NodeSetup& setup)
    : FlightLeaf(setup),
      door_(setup, "door"),
      outside_(setup, "outside"),
      within_m_(setup, "within_m"),
      width_m_(setup, "width_m"),
      tolerance_m_(setup, "tolerance_m"),
      clearance_m_(setup, "clearance_m"),
      mode_(setup, "mode") {}

void LeaveByDoor::onStart(tree::TickContext& context) {
  FlightLeaf::onStart(context);
  leg_.reset();
  why_not_door_.clear();
}

tl::expected<LeaveByDoor::Ports, std::string> LeaveByDoor::ports(const FlightTick& tick) const {
  const auto door = door_.get(), outside = outside_.get();
  const auto within_m = within_m_.get(), width_m = width_m_.get();
  const auto tolerance_m = tolerance_m_.get(), clearance_m = clearance_m_.get();
  const auto mode = modeOr(mode_, tick.mode);
  if (!door) return tl::unexpected(door_.problem());
  if (!outside) return tl::unexpected(outside_.problem());
  if (!within_m) return tl::unexpected(within_m_.problem());
  if (!width_m) return tl::unexpected(width_m_.problem());
  if (!tolerance_m) return tl::unexpected(tolerance_m_.problem());
  if (!clearance_m) return tl::unexpected(clearance_m_.problem());
  if (!mode) return tl::unexpected(mode_.problem());
  const auto places = NamedPlaces::in(*tick.flight.world);
  if (!places) return tl::unexpected(places.error());
  return Ports{
      places->inMap_m(*door), places->inMap_m(*outside), *within_m, *width_m, *tolerance_m, *clearance_m, *mode};
}

void LeaveByDoor::begin(Leg leg, const Eigen::Vector2d& goal_map_m, double tolerance_m, double shift_m,
                        const Ports& ports) {
  leg_ = leg;
  intent_ = {};
  intent_.goal_map_m = goal_map_m;
  intent_.tolerance_m = tolerance_m;
  intent_.shift_m = shift_m;
  intent_.clearance_m = ports.clearance_m;
  intent_.mode = ports.mode;
  renewIntent();
}

void LeaveByDoor::chooseDoor(FlightTick& tick, const Ports& ports) {
  if (leg_ && leg_ != Leg::kToDoor) return;
  const common::World& world = *tick.flight.world;
  const auto tell = [&](const std::string& which) { tick.say(common::Severity::kInfo, "leaves by the door", which); };
  for (const common::RecognizedObject* door : objectsNear(world, "door", ports.door_map_m, ports.within_m)) {
    if (!isOpenFor(*door, ports.width_m)) continue;
    const Eigen::Vector2d middle_map_m = door->T_map_object.position_m.head<2>();
    const Eigen::Vector2d through = directionThrough(*door, world.vehicle->state.T_map_body_planar().position_m());
    tell(fmt::format("door {} is open, {:.2f} m wide, at {}", door->id, door->size_m.x(),
                     world.map->names().of(middle_map_m)));
    return begin(Leg::kBehindDoor, middle_map_m + kBehindDoor_m * through, kDoorTolerance_m, kDoorTolerance_m, ports);
  }
  if (leg_) return;
  tell("no open door is recognized, so by the stored place " + world.map->names().of(ports.door_map_m));
  begin(Leg::kToDoor, ports.door_map_m, kDoorTolerance_m, kStoredShift_m, ports);
}

Status LeaveByDoor::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  const auto ports = this->ports(tick);
  if (!ports) return fail(context, ports.error());
  chooseDoor(tick, *ports);
  emitIntent(tick, intent_);
  const common::IntentState state = intentState(tick);
  if (state == common::IntentState::kRunning) return Status::kRunning;
  if (*leg_ == Leg::kOutside) {
    if (state == common::IntentState::kSucceeded) return Status::kSuccess;
    return fail(context, tick.flight.status.reason +
                             (why_not_door_.empty() ? "" : "; the door was not reached: " + why_not_door_));
  }
  // What is outside may be seen from here although the door itself was not reached.
  if (state == common::IntentState::kFailed) why_not_door_ = tick.flight.status.reason;
  begin(Leg::kOutside, ports->outside_map_m, ports->tolerance_m, kStoredShift_m, *ports);
  return Status::kRunning;
}

}  // namespace

void addLeaveByDoor(tree::Registry& registry) { registry.add<LeaveByDoor>(); }

}  // namespace swiftlet::behaviors
