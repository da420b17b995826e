// FollowMe: stays `distance_m` behind a walking person, with the camera on that person; RUNNING until a node above
// it ends it, and FAILURE when no person is seen for `lost_s`. ReturnToMe: flies to where the person was last followed;
// SUCCESS near that person.
#pragma once

#include <string>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

/// What both share.
class PersonLeaf : public IntentLeaf {
 public:
  PersonLeaf(const tree::NodeSetup& setup, bool until_near);

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  bool until_near_;
  tree::Input<double> distance_m_;
  tree::Input<tree::Duration> lost_s_;
  tree::Input<double> clearance_m_;
  tree::Input<std::string> mode_;
};

class FollowMe final : public PersonLeaf {
 public:
  explicit FollowMe(const tree::NodeSetup& setup) : PersonLeaf(setup, false) {}
  static tree::NodeManifest manifest();
};

class ReturnToMe final : public PersonLeaf {
 public:
  explicit ReturnToMe(const tree::NodeSetup& setup) : PersonLeaf(setup, true) {}
  static tree::NodeManifest manifest();
};

}  // namespace swiftlet::behaviors
