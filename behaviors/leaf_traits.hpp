// What the leaves of a mission do, as far as the checks of missions need it: a line a leaf. How a leaf may end is in
// its manifest.
#pragma once

#include <string_view>
#include <vector>

#include "behaviors/tree/node_record.hpp"
#include "behaviors/tree/outcomes.hpp"
#include "behaviors/tree/tree.hpp"

namespace swiftlet::behaviors {

/// What a leaf does with the vehicle whenever it is ticked. AvoidObstacle and Hold are active only in flight: kNone.
enum class VehicleUse : unsigned char { kNone, kTakesOff, kFlies, kLands };
/// A map of the place that was made before the flight.
enum class MapUse : unsigned char { kNone, kNeeds, kLoads };

struct LeafTraits {
  VehicleUse vehicle = VehicleUse::kNone;
  bool needs_camera = false;
  bool about_targets = false;  ///< Those that the profile names.
  MapUse map = MapUse::kNone;
  bool writes_file = false;                   ///< Under the name in its port `file`.
  bool keeps_out = false;                     ///< The vehicle does not enter the area in its port `polygon`.
  bool obeys_operator = false;                ///< The operator gives the goals, and decides when the vehicle lands.
  bool asks_operator = false;                 ///< It waits until the operator says "go on".
  const char* never_succeeds_at_0 = nullptr;  ///< The port; null: no port decides that.
};

/// Null for a type that is no leaf of a mission, as the nodes of the engine.
const LeafTraits* findTraits(std::string_view id);
/// No trait at all for a node of the engine.
const LeafTraits& traitsOf(const tree::NodeRecord& node);

/// How the nodes of a mission may end, by node id.
std::vector<tree::Outcomes> missionOutcomes(const tree::Tree& tree);

}  // namespace swiftlet::behaviors
