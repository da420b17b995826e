#include "behaviors/load_map.hpp"

#include "behaviors/leaf_traits.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest LoadMap::manifest() {
  return {.id = "LoadMap",
          .kind = tree::NodeKind::kAction,
          .ports = {{.name = "file",
                     .type = tree::PortType::kString,
                     .required = true,
                     .description = "A map of map_server (YAML), beside the mission's file or where missions are."}},
          .description = "Gives the flight another map to find itself in.",
          .details =
              "From now on it is the given one, also before the take-off. `check`, `fly` and `trial` read it before "
              "the flight and refuse one that cannot be used.",
          .ends = "SUCCESS at once; FAILURE for a map that was not read before the flight",
          .traits = LeafTraits{.map = MapUse::kLoads}};
}

RequestLeaf::RequestOrProblem LoadMap::makeRequest(const FlightTick&) {
  const auto file = file_.get();
  if (!file) return tl::unexpected(file_.problem());
  return common::LoadMapRequest{*file};
}

}  // namespace swiftlet::behaviors
