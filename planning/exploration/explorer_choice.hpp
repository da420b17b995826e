// Which explorer chooses the viewpoints; a system profile chooses it.
#pragma once

#include <memory>

#include "common/config_fwd.hpp"
#include "planning/exploration/exploration.hpp"
#include "planning/exploration/exploration_config.hpp"

namespace swiftlet::planning {

/// By what is seen for the time it takes, or the nearest frontier (Yamauchi 1997).
enum class ExplorerKind { kUtility, kNearestFrontier };

struct ExplorerConfig {
  ExplorerKind kind = ExplorerKind::kUtility;

  void describe(common::config::Fields& fields);
};

std::unique_ptr<Explorer> makeExplorer(const ExplorerConfig& config, const ExplorationConfig& exploration);

}  // namespace swiftlet::planning
