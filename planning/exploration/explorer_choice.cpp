#include "planning/exploration/explorer_choice.hpp"

#include "common/check.hpp"
#include "common/config_fields.hpp"
#include "planning/exploration/nearest_frontier_explorer.hpp"
#include "planning/exploration/utility_explorer.hpp"

namespace swiftlet::planning {

void ExplorerConfig::describe(common::config::Fields& fields) {
  fields.choice("kind", kind, {"utility", "nearest_frontier"}, "How the next viewpoint is chosen.");
}

std::unique_ptr<Explorer> makeExplorer(const ExplorerConfig& config, const ExplorationConfig& exploration) {
  switch (config.kind) {
    case ExplorerKind::kUtility:
      return std::make_unique<UtilityExplorer>(exploration);
    case ExplorerKind::kNearestFrontier:
      return std::make_unique<NearestFrontierExplorer>(exploration);
  }
  SWIFTLET_CHECK(false, static_cast<int>(config.kind));
  return nullptr;
}

}  // namespace swiftlet::planning
