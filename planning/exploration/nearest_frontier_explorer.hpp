// The baseline: it flies to the nearest frontier and looks from there (Yamauchi 1997, "A frontier-based approach for
// autonomous exploration", section 3.2). It considers neither the gain there nor whether the laser fixes the pose.
#pragma once

#include "planning/exploration/exploration.hpp"
#include "planning/exploration/exploration_config.hpp"

namespace swiftlet::planning {

/// The viewpoint is the place next to a frontier, or as near to it as the hull fits, that is cheapest to reach. It
/// faces the unknown. A viewpoint is kept until it is reached or its frontier is gone. Gains and weights of the
/// configuration have no influence on the choice.
class NearestFrontierExplorer final : public Explorer {
 public:
  explicit NearestFrontierExplorer(const ExplorationConfig& config) : config_(config) {}
  [[nodiscard]] ExplorationResult explore(const ExplorationInput& input) const override;
  const char* name() const override { return "nearest frontier"; }

 private:
  ExplorationConfig config_;
};

}  // namespace swiftlet::planning
