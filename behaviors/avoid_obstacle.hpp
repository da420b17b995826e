// AvoidObstacle: active in flight while the reactive layer retreats from something unmapped or closing.
// SKIPPED otherwise, SUCCESS when the danger is over. The layer itself acts at the laser rate under every intent; this
// node stays active for it, so that no other intent works against the retreat. [UNB III-A, Fig. 5]
#pragma once

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class AvoidObstacle final : public FlightLeaf {
 public:
  using FlightLeaf::FlightLeaf;
  static tree::NodeManifest manifest();

 private:
  std::string whyItWants(const tree::TickContext& context) const override;
  bool onAsked(const tree::TickContext& context) const override;
  tree::Status act(tree::TickContext& context) override;
};

}  // namespace swiftlet::behaviors
