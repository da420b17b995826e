// LookAround: looks with the camera at every free place of the map. SUCCESS when none is left that can be looked at.
#include "behaviors/leaves.hpp"

#include "behaviors/explore_ports.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/looking_leaf.hpp"

namespace swiftlet::behaviors {
namespace {

class LookAround final : public LookingLeaf {
 public:
  explicit LookAround(const tree::NodeSetup& setup) : LookingLeaf(setup), range_m_(setup, "range_m"), ports_(setup) {}
  static tree::NodeManifest manifest();

 private:
  tree::Status act(tree::TickContext& context) override;
  tree::Input<double> range_m_;
  ExplorePorts ports_;
};

tree::NodeManifest LookAround::manifest() {
  tree::NodeManifest manifest{.id = "LookAround",
                              .kind = tree::NodeKind::kAction,
                              .ports = {rangePort()},
                              .description = "Looks with the camera at every free place of the map.",
                              .details =
                                  "From within `range_m`, the nearest unseen place first; what stands on the floor "
                                  "there and on a table must be in the picture.",
                              .ends = "SUCCESS when no such place is left",
                              .traits = LeafTraits{.needs_camera = true}};
  for (tree::PortManifest& port : ExplorePorts::manifests()) manifest.ports.push_back(std::move(port));
  return manifest;
}

tree::Status LookAround::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  const auto range_m = range_m_.get();
  const auto limits = ports_.intent(tick.mode, *tick.flight.world);
  if (!range_m) return fail(context, range_m_.problem());
  if (!limits) return fail(context, limits.error());
  see(tick, *range_m);
  return lookOn(tick, {*range_m, limits->clearance_m, limits->bounds, limits->leave_building}) ? tree::Status::kRunning
                                                                                               : tree::Status::kSuccess;
}

}  // namespace

void addLookAround(tree::Registry& registry) { registry.add<LookAround>(); }

}  // namespace swiftlet::behaviors
