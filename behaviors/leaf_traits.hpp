// What the checks of missions need to know of a leaf beyond its ports: LeafTraits in its manifest (`traits`).
#pragma once

#include <optional>
#include <vector>

namespace swiftlet::tree {
class Tree;
struct NodeRecord;
struct Outcomes;
}  // namespace swiftlet::tree

namespace swiftlet::behaviors {

/// What a leaf does with the vehicle whenever it is ticked.
enum class VehicleUse : unsigned char { kNone, kTakesOff, kFlies, kLands };
/// A map of the place that was made before the flight.
enum class MapUse : unsigned char { kNone, kNeeds, kLoads };

struct LeafTraits {
  /// nullopt: a FlightLeaf that cannot be SKIPPED flies, and nothing else does.
  std::optional<VehicleUse> vehicle = std::nullopt;
  bool needs_camera = false;
  bool about_targets = false;  ///< Those that the profile names.
  MapUse map = MapUse::kNone;
  bool writes_file = false;                   ///< Under the name in its port `file`.
  bool keeps_out = false;                     ///< The vehicle does not enter the area in its port `polygon`.
  bool obeys_operator = false;                ///< The operator gives the goals, and decides when the vehicle lands.
  bool asks_operator = false;                 ///< It waits until the operator says "go on".
  const char* never_succeeds_at_0 = nullptr;  ///< The port; null: no port decides that.
};

/// With `vehicle`. A node of the engine has no trait.
LeafTraits traitsOf(const tree::NodeRecord& node);

/// How the nodes of a mission may end, by node id.
std::vector<tree::Outcomes> missionOutcomes(const tree::Tree& tree);

}  // namespace swiftlet::behaviors
