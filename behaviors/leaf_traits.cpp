#include "behaviors/leaf_traits.hpp"

#include <any>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/node_record.hpp"
#include "behaviors/tree/outcomes.hpp"

namespace swiftlet::behaviors {

LeafTraits traitsOf(const tree::NodeRecord& node) {
  if (node.manifest == nullptr) return {.vehicle = VehicleUse::kNone};
  const auto* said = std::any_cast<LeafTraits>(&node.manifest->traits);
  LeafTraits traits = said == nullptr ? LeafTraits{} : *said;
  const bool flies = !node.manifest->may_skip && dynamic_cast<const FlightLeaf*>(node.node) != nullptr;
  if (!traits.vehicle) traits.vehicle = flies ? VehicleUse::kFlies : VehicleUse::kNone;
  return traits;
}

std::vector<tree::Outcomes> missionOutcomes(const tree::Tree& tree) {
  return tree::outcomesOf(tree, [&](const tree::NodeRecord& leaf) -> std::optional<tree::Outcomes> {
    const char* port = traitsOf(leaf).never_succeeds_at_0;
    if (port == nullptr || !tree::isAlways(tree, leaf, port, 0)) return std::nullopt;
    return tree::Outcomes{.failure = true};
  });
}

}  // namespace swiftlet::behaviors
