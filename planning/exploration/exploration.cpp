#include "planning/exploration/exploration.hpp"

#include "common/check.hpp"
#include "common/config_fields.hpp"

namespace swiftlet::planning {

void ExplorerConfig::describe(common::config::Fields& fields) {
  fields.choice("kind", kind, {"utility", "nearest_frontier"}, "How the next viewpoint is chosen.");
}

const char* toString(ExplorerKind kind) { return kind == ExplorerKind::kUtility ? "utility" : "nearest frontier"; }

ExplorationResult explore(const ExplorationInput& input, const ExplorerConfig& config) {
  switch (config.kind) {
    case ExplorerKind::kUtility:
      return exploreByUtility(input, config);
    case ExplorerKind::kNearestFrontier:
      return exploreNearestFrontier(input, config);
  }
  SWIFTLET_CHECK(false, static_cast<int>(config.kind));
  return {};
}

}  // namespace swiftlet::planning
