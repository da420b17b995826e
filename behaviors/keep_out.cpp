// KeepOut: the vehicle keeps out of `polygon` for the rest of the flight, whatever it does: planning, exploring, flying
// home, and braking. SUCCESS when that holds; FAILURE for a polygon that cannot be kept out of, or whose
// place in the given map is not known. It stays where it was made, also if the localization moves the given map.
#include "behaviors/leaves.hpp"

#include "behaviors/leaf_traits.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/ports.hpp"
#include "behaviors/request_leaf.hpp"

namespace swiftlet::behaviors {
namespace {

class KeepOut final : public RequestLeaf {
 public:
  explicit KeepOut(const tree::NodeSetup& setup) : RequestLeaf(setup), polygon_(setup, "polygon") {}
  static tree::NodeManifest manifest();

 private:
  RequestOrProblem makeRequest(const FlightTick& tick) override;
  tree::Input<tree::Points> polygon_;
};

tree::NodeManifest KeepOut::manifest() {
  return {.id = "KeepOut",
          .kind = tree::NodeKind::kAction,
          .ports = {polygonPort("that the hull stays out of")},
          .description = "Keeps the vehicle out of an area for the rest of the flight.",
          .details = "It does not fly and may stand before the take-off; the zone stays when the leaf is halted.",
          .ends = "SUCCESS when that holds; FAILURE for a polygon that is not valid, or that holds the take-off place",
          .traits = LeafTraits{.keeps_out = true}};
}

RequestLeaf::RequestOrProblem KeepOut::makeRequest(const FlightTick& tick) {
  const auto points = polygon_.get();
  if (!points) return tl::unexpected(polygon_.problem());
  const auto places = NamedPlaces::in(*tick.flight.world);
  if (!places) return tl::unexpected(places.error());
  return common::KeepOutRequest{places->inMap(*points)};
}

}  // namespace

void addKeepOut(tree::Registry& registry) { registry.add<KeepOut>(); }

}  // namespace swiftlet::behaviors
