// SaveMap: writes the present map into the run's folder, as map-FILE.pgm and map-FILE.yaml. SUCCESS when it is handed
// to the writer.
#pragma once

#include <string>

#include "behaviors/request_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class SaveMap final : public RequestLeaf {
 public:
  explicit SaveMap(const tree::NodeSetup& setup) : RequestLeaf(setup), file_(setup, "file") {}
  static tree::NodeManifest manifest();

 private:
  RequestOrProblem makeRequest(const FlightTick& tick) override;
  tree::Input<std::string> file_;
};

}  // namespace swiftlet::behaviors
