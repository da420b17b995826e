// TakeOff: SUCCESS when the vehicle hovers at height_m above the take-off floor.
#include "behaviors/leaves.hpp"

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_traits.hpp"
#include "common/goal.hpp"

namespace swiftlet::behaviors {
namespace {

class TakeOff final : public IntentLeaf {
 public:
  explicit TakeOff(const tree::NodeSetup& setup) : IntentLeaf(setup), height_m_(setup, "height_m") {}
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  tree::Input<double> height_m_;
};

tree::NodeManifest TakeOff::manifest() {
  return {.id = "TakeOff",
          .kind = tree::NodeKind::kAction,
          .ports = {{.name = "height_m",
                     .type = tree::PortType::kDouble,
                     .default_value = "1.0",
                     .minimum = common::kLeastFlightHeight_m,
                     .maximum = 100.0,
                     .description = "Height above the take-off floor."},
                    {.name = "max_height_m",
                     .type = tree::PortType::kDouble,
                     .required = false,
                     .minimum = common::kLeastFlightHeight_m,
                     .maximum = 100.0,
                     .description = "Greatest height of the whole mission, for a building that is high enough; "
                                    "without it that of the vehicle."},
                    {.name = "home_on_failure",
                     .type = tree::PortType::kBool,
                     .default_value = "true",
                     .description =
                         "If the mission fails in flight and a path home is known, it flies home to land; `false`: "
                         "it lands where it is."}},
          .description = "Climbs from the floor to a height and hovers.",
          .ends = "SUCCESS when it hovers there",
          .traits = LeafTraits{.vehicle = VehicleUse::kTakesOff}};
}

IntentLeaf::IntentOrProblem TakeOff::makeIntent(const FlightTick&) {
  const auto height_m = height_m_.get();
  if (!height_m) return tl::unexpected(height_m_.problem());
  return common::TakeOffIntent{*height_m};
}

}  // namespace

void addTakeOff(tree::Registry& registry) { registry.add<TakeOff>(); }

}  // namespace swiftlet::behaviors
