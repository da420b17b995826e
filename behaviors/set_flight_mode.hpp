// SetFlightMode: what follows is flown in `mode`, wherever a behaviour names no mode of its own. SUCCESS at once.
#pragma once

#include <string>

#include "behaviors/flight_tick.hpp"
#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class SetFlightMode final : public tree::Leaf {
 public:
  explicit SetFlightMode(const tree::NodeSetup& setup) : Leaf(setup), mode_(setup, "mode") {}
  static tree::NodeManifest manifest();

 private:
  tree::Status act(tree::TickContext& context) override;
  tree::Input<std::string> mode_;
};

}  // namespace swiftlet::behaviors
