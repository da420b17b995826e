// LookAround: looks with the camera at every free place of the map. SUCCESS when none is left that can be looked at.
#pragma once

#include "behaviors/explore_ports.hpp"
#include "behaviors/looking_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class LookAround final : public LookingLeaf {
 public:
  explicit LookAround(const tree::NodeSetup& setup) : LookingLeaf(setup), range_m_(setup, "range_m"), ports_(setup) {}
  static tree::NodeManifest manifest();

 private:
  tree::Status act(tree::TickContext& context) override;
  tree::Input<double> range_m_;
  ExplorePorts ports_;
};

}  // namespace swiftlet::behaviors
