#include "behaviors/save_map.hpp"

#include "behaviors/leaf_traits.hpp"
#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest SaveMap::manifest() {
  return {.id = "SaveMap",
          .kind = tree::NodeKind::kAction,
          .ports = {fileNamePort("map")},
          .description = "Writes the present map into the folder of the run.",
          .details = "As `map-FILE.pgm` and `.yaml`.",
          .ends = "SUCCESS at once",
          .traits = LeafTraits{.writes_file = true}};
}

RequestLeaf::RequestOrProblem SaveMap::makeRequest(const FlightTick&) {
  const auto file = file_.get();
  if (!file) return tl::unexpected(file_.problem());
  if (std::string problem = fileNameProblem(*file); !problem.empty()) return tl::unexpected(problem);
  return common::SaveMapRequest{*file};
}

}  // namespace swiftlet::behaviors
