// ExploreUntilFound: explores until `count` targets of a name are found, and then looks with the camera at what it has
// not seen yet. SUCCESS when they are found; FAILURE when nothing is left to look at, or when exploring fails.
//
//   explore --nothing left--> look at the nearest unseen place --> at the next ... --nothing left--> FAILURE
//       \-------- enough found, the vehicle has stopped -------/ --> SUCCESS
#pragma once

#include <cstdint>
#include <string>

#include "behaviors/explore_ports.hpp"
#include "behaviors/looking_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class ExploreUntilFound final : public LookingLeaf {
 public:
  explicit ExploreUntilFound(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  void onStart(tree::TickContext& context) override;
  tree::Status act(tree::TickContext& context) override;
  /// Empty while exploring continues; else why it has failed.
  std::string explore(FlightTick& tick, const common::ExploreIntent& intent);

  tree::Input<std::string> name_;
  tree::Input<std::int64_t> count_;
  tree::Input<double> range_m_;
  ExplorePorts ports_;
  bool explored_ = false;
};

}  // namespace swiftlet::behaviors
