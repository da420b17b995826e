// What every explorer starts from: the frontiers of a map, each open or closed for a reason, and the reachable places
// from which they are seen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planning/exploration/exploration.hpp"
#include "planning/exploration/frontiers.hpp"
#include "planning/exploration/viewpoints.hpp"
#include "planning/search/wavefront.hpp"

namespace swiftlet::planning {

/// An open frontier with the places from which it is seen, as Scout::lookouts() gives them; at least one.
struct SeenFrontier {
  std::size_t number = 0;
  std::vector<Lookout> lookouts;
  double nearest_m = 0.0;  ///< Cost of reaching the cheapest of them, in metres of open space.
};

/// The survey of one call of an explorer. It refers to the arguments of that call, which must outlive it. Not
/// thread-safe.
class FrontierSurvey {
 public:
  explicit FrontierSurvey(const ExplorationInput& input);

  /// Whether the vehicle cannot leave its place. Then no other member but finish() may be called.
  bool shutIn() const { return shut_in_; }

  const CostMap& map() const { return map_; }
  /// The cost of reaching each cell from the vehicle.
  const CostField& field() const { return field_; }
  const FrontierRun& run(std::size_t number) const { return runs_[number]; }

  /// The open frontiers that are seen from a reachable place, the nearest first. The others are closed, as unreachable
  /// or because there are no walls around them to match a scan with.
  std::vector<SeenFrontier> seenBy(const Scout& scout);
  /// Closes a frontier for a reason: it will not be explored.
  void leave(std::size_t number, common::FrontierReason reason, const std::string& detail);
  /// Sets the score by which frontiers are sorted.
  void score(std::size_t number, double score) { frontiers_[number].score = score; }

  /// Of the given frontiers, the one that the current viewpoint is for: the nearest with a cell so near
  /// to its target that a view from it counts as an attempt. None without a current viewpoint, without such a frontier,
  /// or when the viewpoint cannot be reached any more.
  std::optional<std::size_t> ofCurrent(const std::vector<std::size_t>& numbers) const;
  /// The current viewpoint as a lookout in this map. Call it only after ofCurrent() has returned a frontier.
  Lookout currentLookout() const;

  /// Whether an earlier attempt at the lookout's target was made from about the same place. A view from elsewhere then
  /// promises more.
  bool lookedFrom(const Lookout& lookout) const;

  /// The result: the frontiers, the chosen viewpoint, and the reason in words. The survey must not be used afterwards.
  ExplorationResult finish(std::optional<Viewpoint> next, bool kept_current);

 private:
  common::Frontier described(const FrontierRun& run) const;
  bool isAt(const ExplorationAttempt& attempt, const Eigen::Vector2d& target_map_m) const;
  bool isLost(const Eigen::Vector2d& centroid_map_m) const;
  int attemptsAt(const Eigen::Vector2d& target_map_m) const;
  double freeArea_m2() const;

  const ExplorationInput& input_;
  const CostMap& map_;
  std::vector<FrontierRun> runs_;
  std::vector<common::Frontier> frontiers_;  ///< One for each of runs_.
  CostField field_;
  bool shut_in_ = false;
};

}  // namespace swiftlet::planning
