#include "behaviors/keep_out.hpp"

#include "behaviors/named_places.hpp"
#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest KeepOut::manifest() {
  return {.id = "KeepOut",
          .kind = tree::NodeKind::kAction,
          .ports = {polygonPort("that the hull stays out of")},
          .description = "Keeps the vehicle out of an area for the rest of the flight."};
}

RequestLeaf::RequestOrProblem KeepOut::makeRequest(const FlightTick& tick) {
  const auto points = polygon_.get();
  if (!points) return tl::unexpected(polygon_.problem());
  const auto places = NamedPlaces::in(*tick.flight.world);
  if (!places) return tl::unexpected(places.error());
  return common::KeepOutRequest{places->inMap(*points)};
}

}  // namespace swiftlet::behaviors
