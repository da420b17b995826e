// Inspect: orbits `point` at `radius_m` with the camera on it. SUCCESS after `turns`; parts of the circle that are not
// free are left out; FAILURE when no part is. The place of the point in a given map is looked up once, when it
// begins.
#pragma once

#include <string>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class Inspect final : public IntentLeaf {
 public:
  explicit Inspect(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  tree::Input<tree::Point> point_;
  tree::Input<double> radius_m_, turns_, height_m_, clearance_m_;
  tree::Input<std::string> mode_;
};

}  // namespace swiftlet::behaviors
