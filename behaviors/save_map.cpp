#include "behaviors/save_map.hpp"

#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest SaveMap::manifest() {
  return {.id = "SaveMap",
          .kind = tree::NodeKind::kAction,
          .ports = {fileNamePort("map")},
          .description = "Writes the present map into the folder of the run."};
}

RequestLeaf::RequestOrProblem SaveMap::makeRequest(const FlightTick&) {
  const auto file = file_.get();
  if (!file) return {std::nullopt, file_.problem()};
  if (std::string problem = fileNameProblem(*file); !problem.empty()) return {std::nullopt, problem};
  return {common::SaveMapRequest{*file}, {}};
}

}  // namespace swiftlet::behaviors
