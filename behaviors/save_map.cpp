// SaveMap: writes the present map into the run's folder, as map-FILE.pgm and map-FILE.yaml. SUCCESS when it is handed
// to the writer.
#include "behaviors/leaves.hpp"

#include <string>

#include "behaviors/leaf_traits.hpp"
#include "behaviors/ports.hpp"
#include "behaviors/request_leaf.hpp"

namespace swiftlet::behaviors {
namespace {

class SaveMap final : public RequestLeaf {
 public:
  explicit SaveMap(const tree::NodeSetup& setup) : RequestLeaf(setup), file_(setup, "file") {}
  static tree::NodeManifest manifest();

 private:
  RequestOrProblem makeRequest(const FlightTick& tick) override;
  tree::Input<std::string> file_;
};

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
  if (const auto problem = fileNameProblem(*file)) return tl::unexpected(problem->text());
  return common::SaveMapRequest{*file};
}

}  // namespace

void addSaveMap(tree::Registry& registry) { registry.add<SaveMap>(); }

}  // namespace swiftlet::behaviors
