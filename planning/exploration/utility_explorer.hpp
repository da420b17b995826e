// Chooses the viewpoint that shows most for its travel time. Each frontier (Yamauchi 1997, used by Saeedi, section
// III-F) is given the best place to see it from. Places are scored by the unknown area expected to be seen, by the
// travel time, and by how well the laser fixes the pose there (Bachrach 2009, section 5.4).
#pragma once

#include "planning/exploration/exploration.hpp"
#include "planning/exploration/exploration_config.hpp"

namespace swiftlet::planning {

class UtilityExplorer final : public Explorer {
 public:
  explicit UtilityExplorer(const ExplorationConfig& config) : config_(config) {}
  [[nodiscard]] ExplorationResult explore(const ExplorationInput& input) const override;
  const char* name() const override { return "utility"; }

 private:
  ExplorationConfig config_;
};

}  // namespace swiftlet::planning
