// Survey: flies over `polygon` in lanes so that the sensor sees all of it. SUCCESS after the last lane; known obstacles
// are left out; FAILURE when no place of the lanes is free. The place of the polygon in a given map is looked up once,
// when it begins.
#pragma once

#include <optional>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/message.hpp"
#include "behaviors/tree/registry.hpp"
#include "common/polygon.hpp"

namespace swiftlet::behaviors {

/// Why the area is not surveyed: it is larger than any flight covers. Nothing if it is not.
std::optional<tree::Message> surveyProblem(const common::Polygon& area);

class Survey final : public IntentLeaf {
 public:
  explicit Survey(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  tree::Input<tree::Points> polygon_;
  tree::Input<double> spacing_m_, height_m_, clearance_m_;
  tree::Input<std::string> mode_;
};

}  // namespace swiftlet::behaviors
