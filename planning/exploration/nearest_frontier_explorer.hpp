// The simple baseline: flies to the nearest frontier and looks from there (Yamauchi 1997, "A frontier-based approach
// for autonomous exploration", section 3.2). What is gained there, and whether the laser fixes the pose, does not
// count.
#pragma once

#include "planning/exploration/exploration.hpp"
#include "planning/exploration/exploration_config.hpp"

namespace swiftlet::planning {

/// The place is the cheapest to reach among those next to the frontier, or as near to it as the hull fits; the heading
/// is that towards the unknown. A place is kept until it is reached or its frontier is gone. Of the configuration it
/// uses what frontiers are and when one is left; the gains and weights are not for it.
class NearestFrontierExplorer final : public Explorer {
 public:
  explicit NearestFrontierExplorer(const ExplorationConfig& config) : config_(config) {}
  [[nodiscard]] ExplorationResult explore(const ExplorationInput& input) const override;
  const char* name() const override { return "nearest frontier"; }

 private:
  ExplorationConfig config_;
};

}  // namespace swiftlet::planning
