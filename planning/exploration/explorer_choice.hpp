// The choice of the explorer by a system profile.
#pragma once

#include <memory>

#include "common/config_fwd.hpp"
#include "planning/exploration/exploration.hpp"
#include "planning/exploration/exploration_config.hpp"

namespace swiftlet::planning {

/// The viewpoint with the greatest gain for its travel time, or the nearest frontier (Yamauchi 1997).
enum class ExplorerKind { kUtility, kNearestFrontier };

struct ExplorerConfig {
  ExplorerKind kind = ExplorerKind::kUtility;

  void describe(common::config::Fields& fields);
};

std::unique_ptr<Explorer> makeExplorer(const ExplorerConfig& config, const ExplorationConfig& exploration);

}  // namespace swiftlet::planning
