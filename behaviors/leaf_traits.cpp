#include "behaviors/leaf_traits.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace swiftlet::behaviors {
namespace {

struct Line {
  std::string_view id;
  LeafTraits traits;
};

constexpr VehicleUse kFlies = VehicleUse::kFlies, kLands = VehicleUse::kLands;

constexpr std::array kLines = {
    Line{"TakeOff", {.vehicle = VehicleUse::kTakesOff}},
    Line{"Land", {.vehicle = kLands}},
    Line{"EmergencyLand", {.vehicle = kLands}},
    Line{"Hold", {}},
    Line{"AvoidObstacle", {}},
    Line{"Explore", {.vehicle = kFlies}},
    Line{"ExploreUntilFound", {.vehicle = kFlies, .needs_camera = true, .about_targets = true}},
    Line{"LoadMap", {.map = MapUse::kLoads}},
    Line{"Localize", {.vehicle = kFlies, .map = MapUse::kNeeds}},
    Line{"Relocalize", {.vehicle = kFlies, .map = MapUse::kNeeds}},
    Line{"MoveToGoal", {.vehicle = kFlies}},
    Line{"TurnTo", {.vehicle = kFlies}},
    Line{"FollowPath", {.vehicle = kFlies}},
    Line{"Patrol", {.vehicle = kFlies, .never_succeeds_at_0 = "rounds"}},
    Line{"GoHome", {.vehicle = kFlies}},
    Line{"Survey", {.vehicle = kFlies}},
    Line{"Inspect", {.vehicle = kFlies, .needs_camera = true}},
    Line{"LocateTarget", {.vehicle = kFlies, .needs_camera = true, .about_targets = true}},
    Line{"LookAround", {.vehicle = kFlies, .needs_camera = true}},
    Line{"FollowMe", {.vehicle = kFlies}},
    Line{"ReturnToMe", {.vehicle = kFlies}},
    Line{"OperatorCommand", {.vehicle = kFlies, .obeys_operator = true}},
    Line{"Photograph", {.vehicle = kFlies, .needs_camera = true, .writes_file = true}},
    Line{"SaveMap", {.writes_file = true}},
    Line{"KeepOut", {.keeps_out = true}},
    Line{"SetFlightMode", {}},
    Line{"WaitForOperator", {.asks_operator = true}},
    Line{"LogEvent", {}},
    Line{"IsBatteryLow", {}},
    Line{"IsHomeReachable", {}},
    Line{"IsLost", {}},
    Line{"IsOperatorHolding", {}},
    Line{"IsPersonNear", {}},
    Line{"IsExplored", {}},
    Line{"IsAt", {}},
    Line{"IsTargetFound", {.needs_camera = true, .about_targets = true}},
};

}  // namespace

const LeafTraits* findTraits(std::string_view id) {
  const auto* line = std::find_if(kLines.begin(), kLines.end(), [&](const Line& known) { return known.id == id; });
  return line == kLines.end() ? nullptr : &line->traits;
}

const LeafTraits& traitsOf(const tree::NodeRecord& node) {
  static constexpr LeafTraits kOfTheEngine;
  const LeafTraits* traits = findTraits(typeNameOf(node));
  return traits == nullptr ? kOfTheEngine : *traits;
}

std::vector<tree::Outcomes> missionOutcomes(const tree::Tree& tree) {
  return tree::outcomesOf(tree, [&](const tree::NodeRecord& leaf) -> std::optional<tree::Outcomes> {
    const char* port = traitsOf(leaf).never_succeeds_at_0;
    if (port == nullptr || !tree::isAlways(tree, leaf, port, 0)) return std::nullopt;
    return tree::Outcomes{.failure = true};
  });
}

}  // namespace swiftlet::behaviors
