// Localize: explores until the vehicle is localized in the given map, which is SUCCESS. FAILURE if there is no such
// map, if it is found to be that of another place, or if nothing is left to explore.
#include "behaviors/leaves.hpp"

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/ports.hpp"
#include "common/world.hpp"
#include "common/world/map_layer.hpp"

namespace swiftlet::behaviors {
namespace {

using tree::Status;

class Localize final : public FlightLeaf {
 public:
  explicit Localize(const tree::NodeSetup& setup) : FlightLeaf(setup), clearance_m_(setup, "clearance_m") {}
  static tree::NodeManifest manifest();

 private:
  tree::Status act(tree::TickContext& context) override;
  tree::Input<double> clearance_m_;
};

tree::NodeManifest Localize::manifest() {
  return {.id = "Localize",
          .kind = tree::NodeKind::kAction,
          .ports = {clearancePort()},
          .description = "Explores until the vehicle knows where it is in the map it was given.",
          .details = "The map is that of `--map` or of LoadMap.",
          .ends =
              "SUCCESS when it is localized; FAILURE if no map was given, if it is found to be that of another place, "
              "or if nothing is left to explore",
          .traits = LeafTraits{.map = MapUse::kNeeds}};
}

Status Localize::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  const auto& localization = tick.flight.world->map->localization;
  if (!localization) return fail(context, "the flight was given no map");
  const auto clearance_m = clearance_m_.get();
  if (!clearance_m) return fail(context, clearance_m_.problem());
  emitIntent(tick, common::ExploreIntent{*clearance_m, std::nullopt, false, tick.mode});
  if (localization->localized()) return Status::kSuccess;
  if (localization->refuted) return fail(context, "the given map does not match this place");
  switch (intentState(tick)) {
    case common::IntentState::kRunning:
      return Status::kRunning;
    case common::IntentState::kSucceeded:
      return fail(context,
                  std::string("nothing is left to explore, and the place is still ") + toString(localization->state));
    case common::IntentState::kFailed:
      return fail(context, tick.flight.status.reason);
  }
  return Status::kRunning;
}

}  // namespace

void addLocalize(tree::Registry& registry) { registry.add<Localize>(); }

}  // namespace swiftlet::behaviors
