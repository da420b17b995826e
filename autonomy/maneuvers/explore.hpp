// Explore: flies from viewpoint to viewpoint until every remaining frontier has a reason why it is left.
#pragma once

#include <optional>
#include <string>

#include "autonomy/maneuvers/detour.hpp"
#include "autonomy/maneuvers/path_maneuver.hpp"

namespace swiftlet::autonomy {

class Explore final : public PathManeuver {
 public:
  Explore(const common::ExploreIntent& intent, const ManeuverSetup& setup);
  Progress answered(const PlanningAnswer& answer, common::Time now, const common::VehicleState& state) override;
  /// The viewpoint.
  std::optional<Eigen::Vector2d> goal_map_m() const override;
  std::optional<Eigen::Vector2d> wantsToSee_map_m() const override;

 private:
  Progress fly(const ManeuverInput& input) override;
  double reconsiderAfter_s() const;
  /// True if it has looked long enough from the viewpoint, which is then finished.
  bool look(const ManeuverInput& input);
  void goOn(const PlanningAnswer& answer, common::Time now, const common::VehicleState& state);
  Progress nothingOpen(const planning::ExplorationResult& result, common::Time now);
  Progress explored(const planning::ExplorationResult& result, common::Time now);
  /// The longest frontier that a recently seen person may hide.
  std::optional<Eigen::Vector2d> blockedFrontier(const planning::ExplorationResult& result, common::Time now) const;

  common::ExploreIntent intent_;
  Detour detour_;
  std::string reason_;  ///< Reason of the last answer.
  std::optional<common::Time> asked_;
  std::optional<planning::Viewpoint> viewpoint_;
  std::optional<common::Time> looks_since_;  ///< Since when it has been at the viewpoint with the right heading.
  std::optional<common::Time> shut_in_since_;
  int done_answers_ = 0;                    ///< Number of successive answers without an open frontier.
  std::optional<common::Time> done_since_;  ///< Time of the first of these answers.
  std::optional<Eigen::Vector2d> blocked_frontier_map_m_;
};

}  // namespace swiftlet::autonomy
