// MoveToGoal: SUCCESS when the vehicle is within tolerance_m of `goal` (in `map`: x;y at the present height or at
// `height_m`, or x;y;z with z above the take-off floor) and, where `yaw_deg` is given, looks there. In a flight that
// was given a map, both are those of that map, and FAILURE while the vehicle is not localized in it.
#include "behaviors/leaves.hpp"

#include "behaviors/flight_leaf.hpp"
#include "behaviors/go_to_ports.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {
namespace {

class MoveToGoal final : public IntentLeaf {
 public:
  explicit MoveToGoal(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  bool isOutdated(const FlightTick& tick) const override;
  tree::Input<tree::Point> goal_;
  GoToPorts go_to_;
  tree::Input<double> height_m_;
  tree::Input<double> yaw_deg_;
  common::GoToIntent emitted_;  ///< The present intent.
};

tree::NodeManifest MoveToGoal::manifest() {
  return {.id = "MoveToGoal",
          .kind = tree::NodeKind::kAction,
          .ports = {placePort("goal"),
                    tolerancePort(),
                    shiftPort(),
                    clearancePort(),
                    {.name = "height_m",
                     .type = tree::PortType::kDouble,
                     .description =
                         "Height above the take-off floor, where the goal has no z. Not given: the present height."},
                    headingPort(false),
                    modePort()},
          .description = "Flies to a point of the map.",
          .details = "An event says when a place beside the goal had to do.",
          .ends = "SUCCESS within the tolerance, and, with `yaw_deg`, when it looks there"};
}

MoveToGoal::MoveToGoal(const tree::NodeSetup& setup)
    : IntentLeaf(setup),
      goal_(setup, "goal"),
      go_to_(setup),
      height_m_(setup, "height_m"),
      yaw_deg_(setup, "yaw_deg") {}

IntentLeaf::IntentOrProblem MoveToGoal::makeIntent(const FlightTick& tick) {
  const auto goal = goal_.get();
  if (!goal) return tl::unexpected(goal_.problem());
  auto intent = go_to_.intentTo(*goal, tick, tick.mode);
  if (!intent) return tl::unexpected(intent.error());
  const auto height_m = height_m_.get();
  const auto yaw_deg = yaw_deg_.get();
  if (height_m_.given() && !height_m) return tl::unexpected(height_m_.problem());
  if (yaw_deg_.given() && !yaw_deg) return tl::unexpected(yaw_deg_.problem());
  if (!intent->height_m) intent->height_m = height_m;
  if (yaw_deg) intent->yaw_map_rad = NamedPlaces::in(*tick.flight.world)->yawInMap_rad(*yaw_deg);
  emitted_ = *intent;
  // The goal is not judged by the map here, because the map may be about to grow: the executor does that, and waits.
  const auto verdict = common::judgeGoal(common::goalOf(*intent), tick.flight.goal_limits, nullptr);
  if (!verdict) return tl::unexpected(verdict.error().text);
  return *intent;
}

bool MoveToGoal::isOutdated(const FlightTick& tick) const { return hasMoved(emitted_, *tick.flight.world); }

}  // namespace

void addMoveToGoal(tree::Registry& registry) { registry.add<MoveToGoal>(); }

}  // namespace swiftlet::behaviors
