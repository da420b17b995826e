// FollowMe: stays `distance_m` behind a walking person, with the camera on that person; RUNNING until a node above
// it ends it, and FAILURE when no person is seen for `lost_s`. ReturnToMe: flies to where the person was last followed;
// SUCCESS near that person.
#include "behaviors/leaves.hpp"

#include <string>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {
namespace {

using tree::PortType;

/// What both share.
class PersonLeaf : public IntentLeaf {
 public:
  PersonLeaf(const tree::NodeSetup& setup, bool until_near);

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
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
  explicit ReturnToMe(const tree::NodeSetup& setup) : PersonLeaf(setup, true) {}
  static tree::NodeManifest manifest();
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
  return {.id = "ReturnToMe",
          .kind = tree::NodeKind::kAction,
          .ports = personPorts(),
          .description = "Flies back to the person who was followed.",
          .ends = "SUCCESS near that person; FAILURE if nobody was followed, or nobody is seen for `lost_s`"};
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
