// LoadMap: from now on `file` is the given map, in which the flight finds its place and the mission names its places.
// It starts no flight, and may come before the take-off. SUCCESS when the map is loaded; FAILURE for a map that was not
// read before the flight. `check`, `fly` and `trial` read it and refuse one that cannot be used.
#include "behaviors/leaves.hpp"

#include <string>

#include "behaviors/leaf_traits.hpp"
#include "behaviors/request_leaf.hpp"

namespace swiftlet::behaviors {
namespace {

class LoadMap final : public RequestLeaf {
 public:
  explicit LoadMap(const tree::NodeSetup& setup) : RequestLeaf(setup), file_(setup, "file") {}
  static tree::NodeManifest manifest();

 private:
  RequestOrProblem makeRequest(const FlightTick& tick) override;
  tree::Input<std::string> file_;
};

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

}  // namespace

void addLoadMap(tree::Registry& registry) { registry.add<LoadMap>(); }

}  // namespace swiftlet::behaviors
