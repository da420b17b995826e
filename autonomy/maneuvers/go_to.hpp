// GoTo: flies to a place of the map; done on arrival. Where that place is not free, it waits, and then flies to a free
// place beside it as far as the intent's `shift_m` allows, which may be beyond the tolerance. Without a path it waits
// and makes detours, and finally fails with the planner's reason. Going home is a GoTo with the home pose.
#pragma once

#include <optional>
#include <string>

#include "autonomy/maneuvers/detour.hpp"
#include "autonomy/maneuvers/path_maneuver.hpp"

namespace swiftlet::autonomy {

class GoTo final : public PathManeuver {
 public:
  GoTo(const common::GoToIntent& intent, const ManeuverSetup& setup);
  Progress answered(const PlanningAnswer& answer, common::Time now, const common::VehicleState& state) override;
  std::optional<Eigen::Vector2d> goal_map_m() const override { return intent_.goal_map_m; }

 private:
  /// Since when there has been no path, with the planner's last reason.
  struct NoPath {
    common::Time since;
    planning::PlanFailure failure;
  };

  std::string reached(const common::PlaceNames& names) const;
  bool looksAsAsked(const common::VehicleState& state) const;
  Progress fly(const ManeuverInput& input) override;
  void lookAlongBlockedPath();
  void tellLaserAlone(common::Time now, const planning::PlanFailure& failure);
  Progress waitFor(const planning::PlanFailure& failure, common::Time now);
  bool shiftsAtOnce() const { return intent_.shift_after_s <= 0.0; }
  /// After the goal has not been free for long enough, a free place beside it is accepted.
  void shiftWhenDue(common::Time now);
  /// How long to wait without a path.
  double patience_s() const;

  common::GoToIntent intent_;
  Detour detour_;
  std::optional<NoPath> no_path_;
  std::optional<common::Time> goal_taken_since_;  ///< Since when the goal itself has not been free.
  bool shifted_;                                  ///< Whether a free place beside the goal is accepted.
  bool sees_heights_ = false;                     ///< Whether there is a 3D map.
  Eigen::Vector2d place_map_m_;                   ///< The goal, or the free place that is flown to instead.
  std::optional<Eigen::Vector2d> ahead_map_m_;    ///< Of the last path to the goal, a little ahead of the vehicle.
  common::Time asked_;                            ///< When the path to the goal was last requested.
};

}  // namespace swiftlet::autonomy
