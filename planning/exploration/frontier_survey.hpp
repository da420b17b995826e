// What every explorer starts from: the frontiers of a map, each open or with the reason why it is left, and the places
// they are seen from that the vehicle can reach.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planning/exploration/exploration.hpp"
#include "planning/exploration/exploration_config.hpp"
#include "planning/exploration/frontiers.hpp"
#include "planning/exploration/viewpoints.hpp"
#include "planning/search/wavefront.hpp"

namespace swiftlet::planning {

/// An open frontier with places that see it, as Scout::lookouts() gives them; at least one.
struct SeenFrontier {
  std::size_t number = 0;
  std::vector<Lookout> lookouts;
  double nearest_m = 0.0;  ///< To the cheapest of them, in metres of open space.
};

/// Of one call of an explorer; refers to its arguments, which must outlive it. One thread.
class FrontierSurvey {
 public:
  FrontierSurvey(const ExplorationInput& input, const ExplorationConfig& config);

  /// There is no path out of where the vehicle is: nothing else may be asked but finish().
  bool shutIn() const { return shut_in_; }

  const CostMap& map() const { return map_; }
  /// The cost of reaching each cell from the vehicle.
  const CostField& field() const { return field_; }
  const FrontierRun& run(std::size_t number) const { return runs_[number]; }

  /// The open frontiers that can be seen, the nearest first; the others are left as unreachable.
  std::vector<SeenFrontier> seenBy(const Scout& scout);
  void leave(std::size_t number, common::FrontierReason reason, const std::string& detail);
  void score(std::size_t number, double score) { frontiers_[number].score = score; }

  /// The number of the frontier, among those given, that the viewpoint being flown to is for: it has a cell within
  /// `attempt_radius_m` of the target. None when nothing is left there, or when the place cannot be reached any more.
  std::optional<std::size_t> ofCurrent(const std::vector<std::size_t>& numbers) const;
  /// The viewpoint being flown to, as it is in this map; only after ofCurrent() gave its frontier.
  Lookout currentLookout() const;

  /// Whether one looked from about there already: another look promises more from elsewhere.
  bool lookedFrom(const Lookout& lookout) const;

  /// The answer: the frontiers, what was chosen, the reason in words. The survey is used up.
  ExplorationResult finish(std::optional<Viewpoint> next, bool kept_current);

 private:
  common::Frontier described(const FrontierRun& run) const;
  bool isAt(const ExplorationAttempt& attempt, const Eigen::Vector2d& target_map_m) const;
  int attemptsAt(const Eigen::Vector2d& target_map_m) const;
  double freeArea_m2() const;

  const ExplorationInput& input_;
  const ExplorationConfig& config_;
  const CostMap& map_;
  std::vector<FrontierRun> runs_;
  std::vector<common::Frontier> frontiers_;  ///< One for each run.
  CostField field_;
  bool shut_in_ = false;
};

}  // namespace swiftlet::planning
