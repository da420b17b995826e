// LoadMap: from now on `file` is the given map, in which the flight finds its place and the mission names its places.
// It starts no flight, and may come before the take-off. SUCCESS when the map is loaded; FAILURE for a map that was not
// read before the flight. `check`, `fly` and `trial` read it and refuse one that cannot be used.
#pragma once

#include <string>

#include "behaviors/request_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class LoadMap final : public RequestLeaf {
 public:
  explicit LoadMap(const tree::NodeSetup& setup) : RequestLeaf(setup), file_(setup, "file") {}
  static tree::NodeManifest manifest();

 private:
  RequestOrProblem makeRequest(const FlightTick& tick) override;
  tree::Input<std::string> file_;
};

}  // namespace swiftlet::behaviors
