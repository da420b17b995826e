// AvoidObstacle: has the vehicle while the reactive layer retreats from something unmapped or closing, in flight;
// SKIPPED otherwise, SUCCESS when the danger is over. The layer itself acts at the laser rate under every intent; this
// gives it the vehicle for as long as it takes, so that nothing pulls the other way. [UNB III-A, Fig. 5]
#pragma once

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class AvoidObstacle final : public FlightLeaf {
 public:
  using FlightLeaf::FlightLeaf;
  static tree::NodeManifest manifest();
  std::string reason(const tree::TickContext& context) const override;

 private:
  bool onAsked(const tree::TickContext& context) const override;
  tree::Status act(tree::TickContext& context) override;
};

}  // namespace swiftlet::behaviors
