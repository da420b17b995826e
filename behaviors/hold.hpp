// Hold: active while the operator holds or an emergency does; SKIPPED otherwise, SUCCESS when the hold ends.
#pragma once

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class Hold final : public FlightLeaf {
 public:
  using FlightLeaf::FlightLeaf;
  static tree::NodeManifest manifest();

 private:
  std::string whyItWants(const tree::TickContext& context) const override;
  bool onAsked(const tree::TickContext& context) const override { return flightTick(context).flight.hold; }
  tree::Status act(tree::TickContext& context) override;
};

}  // namespace swiftlet::behaviors
