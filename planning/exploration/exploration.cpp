#include "planning/exploration/exploration.hpp"

#include "common/check.hpp"
#include "common/config_fields.hpp"

namespace swiftlet::planning {

void ExplorerConfig::describe(common::config::Fields& fields) {
  fields.choice("kind", kind, {"utility", "nearest_frontier", "tour", "camera_tour"},
                "How the next viewpoint is chosen.");
}

const char* toString(ExplorerKind kind) {
  switch (kind) {
    case ExplorerKind::kUtility:
      return "utility";
    case ExplorerKind::kNearestFrontier:
      return "nearest frontier";
    case ExplorerKind::kTour:
      return "tour";
    case ExplorerKind::kCameraTour:
      return "camera tour";
  }
  return "unknown";
}

ExplorationResult explore(const ExplorationInput& input, const ExplorerConfig& config) {
  switch (config.kind) {
    case ExplorerKind::kUtility:
      return exploreByUtility(input, config);
    case ExplorerKind::kNearestFrontier:
      return exploreNearestFrontier(input, config);
    case ExplorerKind::kTour:
      return exploreByTour(input, config);
    case ExplorerKind::kCameraTour:
      return exploreByCameraTour(input, config);
  }
  SWIFTLET_CHECK(false, static_cast<int>(config.kind));
  return {};
}

}  // namespace swiftlet::planning
