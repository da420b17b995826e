#include "behaviors/keep_out.hpp"

#include "behaviors/leaf_traits.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {

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

}  // namespace swiftlet::behaviors
