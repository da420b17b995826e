// FollowMe: stays `distance_m` behind a walking person, with the camera on that person; RUNNING until a node above
// it ends it, and FAILURE when no person is seen for `lost_s`. ReturnToMe (Saeedi et al., section III-A): flies to a
// person who calls it, at the given place, or where the person was last followed or seen to walk; SUCCESS near that
// place.
#include "behaviors/leaves.hpp"

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/place_around.hpp"
#include "behaviors/ports.hpp"
#include "common/geometry.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

using tree::PortType;

/// What both share.
class PersonLeaf : public IntentLeaf {
 public:
  PersonLeaf(const tree::NodeSetup& setup, bool until_near);

 protected:
  IntentOrProblem makeIntent(const FlightTick& tick) override;

 private:
  bool until_near_;
  tree::Input<double> distance_m_;
  tree::Input<tree::Duration> lost_s_;
  tree::Input<double> clearance_m_;
  tree::Input<std::string> mode_;
};

class FollowMe final : public PersonLeaf {
 public:
  explicit FollowMe(const tree::NodeSetup& setup) : PersonLeaf(setup, false) {}
  static tree::NodeManifest manifest();
};

class ReturnToMe final : public PersonLeaf {
 public:
  explicit ReturnToMe(const tree::NodeSetup& setup) : PersonLeaf(setup, true), place_(setup, "place") {}
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  tree::Input<tree::Point> place_;
};

std::vector<tree::PortManifest> personPorts() {
  return {{.name = "distance_m",
           .type = PortType::kDouble,
           .default_value = "2.0",
           .minimum = 1.5,
           .maximum = 3.0,
           .description = "Distance between the vehicle's centre and the person."},
          {.name = "lost_s",
           .type = PortType::kDuration,
           .default_value = "20",
           .minimum = 3.0,
           .maximum = 3600.0,
           .description = "Time without seeing anybody after which it fails."},
          clearancePort(),
          modePort()};
}

/// The free place at the distance of `asked` from a person that is nearest to the vehicle, and in sight of that person.
std::optional<common::GoToIntent> placeBeside(const FlightTick& tick, const Eigen::Vector2d& person_map_m,
                                              const common::FollowIntent& asked) {
  constexpr int kSidesOfPerson = 36;          // Every 10 degrees.
  constexpr double kPersonStands_m = 0.5;     // What the map has there may be the person.
  constexpr double kBesideTolerance_m = 0.2;  // Within the sway of a person who stands.
  common::GoToIntent beside;
  beside.tolerance_m = kBesideTolerance_m;
  beside.clearance_m = asked.clearance_m;
  beside.mode = asked.mode;
  return nearestPlaceAround(tick, {person_map_m, asked.distance_m, kSidesOfPerson, kPersonStands_m}, beside);
}

tree::NodeManifest FollowMe::manifest() {
  return {
      .id = "FollowMe",
      .kind = tree::NodeKind::kAction,
      .ports = personPorts(),
      .description = "Follows the nearest person who walks.",
      .details =
          "It waits for the nearest person within 6 m who walks and follows along the places where that person walked, "
          "the camera on that person: keeps `distance_m` - 0.3 m to a person who stands, plus 0.6 s of the speed of "
          "one who walks away; gives way to a person who comes too near; turns about while it waits. A person who is "
          "hidden is looked for where people may have walked to, and one who stands so long that the map explains the "
          "place is assumed to be there. `mode=\"brisk\"` keeps up with somebody who walks at 1 m/s.",
      .ends = "never SUCCESS: end it by what stands above it (`Timeout`); FAILURE when nobody was seen for `lost_s`",
      .may_succeed = false};
}

tree::NodeManifest ReturnToMe::manifest() {
  std::vector<tree::PortManifest> ports = personPorts();
  tree::PortManifest place = placePort("place");
  place.required = false;
  place.description =
      "Where the person stands, in the map frame or in the given map. Not given: where the person was last followed, "
      "or "
      "else where the nearest walking person was last seen.";
  ports.push_back(std::move(place));
  return {
      .id = "ReturnToMe",
      .kind = tree::NodeKind::kAction,
      .ports = std::move(ports),
      .description = "Flies back to the person who calls it.",
      .details =
          "It looks at the person and stays `distance_m` away. Without `place`, a person who is seen on the way is "
          "flown to wherever that person goes.",
      .ends =
          "SUCCESS near that person; FAILURE if no place is given and nobody was followed or seen walking, or nobody "
          "is seen for `lost_s` from within 6 m, or no place near the person is free"};
}

/// A place is returned to as to a goal: who calls from there may be hidden, or stand in the map since before it was
/// made.
IntentLeaf::IntentOrProblem ReturnToMe::makeIntent(const FlightTick& tick) {
  IntentOrProblem to_person = PersonLeaf::makeIntent(tick);
  if (!to_person || !place_.given()) return to_person;
  const auto place = place_.get();
  if (!place) return tl::unexpected(place_.problem());
  const auto places = NamedPlaces::in(*tick.flight.world);
  if (!places) return tl::unexpected(places.error());
  const Eigen::Vector2d person_map_m = places->inMap_m(*place);
  const auto beside = placeBeside(tick, person_map_m, std::get<common::FollowIntent>(*to_person));
  if (!beside) return tl::unexpected("no place near " + tick.flight.world->map->names().of(person_map_m) + " is free");
  return *beside;
}

PersonLeaf::PersonLeaf(const tree::NodeSetup& setup, bool until_near)
    : IntentLeaf(setup),
      until_near_(until_near),
      distance_m_(setup, "distance_m"),
      lost_s_(setup, "lost_s"),
      clearance_m_(setup, "clearance_m"),
      mode_(setup, "mode") {}

IntentLeaf::IntentOrProblem PersonLeaf::makeIntent(const FlightTick& tick) {
  const auto distance_m = distance_m_.get();
  const auto lost = lost_s_.get();
  const auto clearance_m = clearance_m_.get();
  const auto mode = modeOr(mode_, tick.mode);
  if (!distance_m) return tl::unexpected(distance_m_.problem());
  if (!lost) return tl::unexpected(lost_s_.problem());
  if (!clearance_m) return tl::unexpected(clearance_m_.problem());
  if (!mode) return tl::unexpected(mode_.problem());
  return common::FollowIntent{*distance_m, 1e-9 * static_cast<double>(lost->nanoseconds), until_near_, *clearance_m,
                              *mode};
}

}  // namespace

void addFollowMe(tree::Registry& registry) {
  registry.add<FollowMe>();
  registry.add<ReturnToMe>();
}

}  // namespace swiftlet::behaviors
