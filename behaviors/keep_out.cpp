#include "behaviors/keep_out.hpp"

#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest KeepOut::manifest() {
  return {.id = "KeepOut",
          .kind = tree::NodeKind::kAction,
          .ports = {polygonPort("that the hull stays out of")},
          .description = "Keeps the vehicle out of an area for the rest of the flight."};
}

RequestLeaf::RequestOrProblem KeepOut::makeRequest(const FlightTick&) {
  const auto points = polygon_.get();
  if (!points) return {std::nullopt, polygon_.problem()};
  return {common::KeepOutRequest{polygonOf(*points)}, {}};
}

}  // namespace swiftlet::behaviors
