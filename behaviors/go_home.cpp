// GoHome: SUCCESS when the vehicle is within tolerance_m of the take-off place. SLAM may correct that place in `map`
// during the flight; a correction of more than half the tolerance renews the intent.
#include "behaviors/leaves.hpp"

#include "behaviors/flight_leaf.hpp"
#include "behaviors/ports.hpp"
#include "common/world.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

class GoHome final : public IntentLeaf {
 public:
  explicit GoHome(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  bool isOutdated(const FlightTick& tick) const override;

  tree::Input<double> tolerance_m_;
  tree::Input<double> clearance_m_;
  common::GoToIntent made_;
};

tree::NodeManifest GoHome::manifest() {
  return {
      .id = "GoHome",
      .kind = tree::NodeKind::kAction,
      .ports = {tolerancePort(), clearancePort()},
      .description = "Flies back to the take-off place.",
      .details = "Also if SLAM corrects that in flight; where it is not free, to the nearest free place within 0.4 m.",
      .ends = "SUCCESS within the tolerance"};
}

GoHome::GoHome(const tree::NodeSetup& setup)
    : IntentLeaf(setup), tolerance_m_(setup, "tolerance_m"), clearance_m_(setup, "clearance_m") {}

IntentLeaf::IntentOrProblem GoHome::makeIntent(const FlightTick& tick) {
  const auto tolerance_m = tolerance_m_.get();
  const auto clearance_m = clearance_m_.get();
  if (!tolerance_m) return tl::unexpected(tolerance_m_.problem());
  if (!clearance_m) return tl::unexpected(clearance_m_.problem());
  made_ = {};
  made_.goal_map_m = tick.flight.world->vehicle->home_map.position_m();
  made_.tolerance_m = *tolerance_m;
  made_.shift_m = common::kHomeShift_m;
  made_.clearance_m = *clearance_m;
  made_.mode = tick.mode;
  return made_;
}

bool GoHome::isOutdated(const FlightTick& tick) const {
  const Eigen::Vector2d home_map_m = tick.flight.world->vehicle->home_map.position_m();
  return (home_map_m - made_.goal_map_m).norm() > 0.5 * made_.tolerance_m;
}

}  // namespace

void addGoHome(tree::Registry& registry) { registry.add<GoHome>(); }

}  // namespace swiftlet::behaviors
