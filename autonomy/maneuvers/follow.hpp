// Follow: keeps a distance from a walking person, with the nose on the person, along the trail that the person walked;
// gives way where the person comes too near.
#pragma once

#include <memory>
#include <optional>

#include "autonomy/maneuvers/path_maneuver.hpp"
#include "autonomy/maneuvers/person_watch.hpp"

namespace swiftlet::autonomy {

/// One thread.
///
///   looks for a walking person ----> follows --> lost: flies to where the person may be --> failed
///                                       ^----------- seen again -----------+
///   To return it first flies to where the last person was, and is done when it is near a person.
class Follow final : public PathManeuver {
 public:
  Follow(const common::FollowIntent& intent, const ManeuverSetup& setup);
  Progress answered(const PlanningAnswer& answer, common::Time now, const common::VehicleState& state) override;
  std::optional<Eigen::Vector2d> goal_map_m() const override { return target_map_m_; }
  std::optional<Eigen::Vector2d> followedPerson_map_m() const override { return setup_.memory.person_map_m; }
  /// Without the person.
  ManeuverInput planningInput(const ManeuverInput& input) const override;

 private:
  void watch(const ManeuverInput& input) override;
  Progress fly(const ManeuverInput& input) override;
  void begin(common::Time now);
  Progress search(const ManeuverInput& input);
  Progress progress(const ManeuverInput& input);
  /// Flies behind the person, or gives way.
  void pursue(const ManeuverInput& input);
  bool comesTooNear(const ManeuverInput& input) const;
  void giveWay(const ManeuverInput& input, const planning::CostMap& costs);
  void flyOrStay(const planning::Path& path, const ManeuverInput& input);
  bool flyAlongTrail(const ManeuverInput& input, const planning::CostMap& costs);
  double pace_m_s(const ManeuverInput& input) const;
  Eigen::Vector2d placeBehind() const;
  void flyTo(const ManeuverInput& input, const Eigen::Vector2d& target_map_m);

  const FollowConfig& config_;
  common::FollowIntent intent_;
  std::shared_ptr<PersonWatch> person_;  ///< Never null after the first watch().
  std::optional<Eigen::Vector2d> target_map_m_;
  std::optional<common::Time> since_, near_since_;
  std::optional<double> since_yaw_rad_;  ///< The heading in `map` when it began to wait for a person.
  common::Time asked_;
  bool on_trail_ = false;  ///< The plan leads along the trail.
  bool lost_ = false;
};

}  // namespace swiftlet::autonomy
