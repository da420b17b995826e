// Finds the floor under the feet and judges contacts: landing on something is allowed, touching anything else ends the
// flight.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/time.hpp"
#include "simulation/doors.hpp"
#include "simulation/people_in_field.hpp"
#include "simulation/quadrotor.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/scenario.hpp"
#include "simulation/truth.hpp"
#include "simulation/walkers.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

class Referee {
 public:
  /// World and rays must outlive it.
  Referee(const WorldModel& world, const RayCaster& rays, const Scenario& scenario);

  /// Highest floor under the feet at the last call of lookDown(); -infinity without a floor.
  double floor_world_m() const { return floor_world_m_; }

  /// Finds the floor under the feet. Call at 100 Hz or more.
  void lookDown(const QuadrotorState& state);

  /// Call after each physics step. Judges whether a touch-down was a landing or a crash.
  void judgeTouchDown(common::Time now, const QuadrotorState& before, const QuadrotorState& after, Truth& truth) const;

  /// Sweeps the hull from its place at the last call. Call at 100 Hz or more. `seen` is LaserScanner::seen(); empty:
  /// every shape is.
  void judgeContacts(common::Time now, const QuadrotorState& state, std::span<const Walker> walkers,
                     std::span<const Door> doors, const std::vector<bool>& seen, Truth& truth);

  /// The surface of the world nearest to the hull at the last call of judgeContacts(), within Truth::kClearanceLimit_m.
  const Clearance& clearance() const { return clearance_; }

  /// Reports another vehicle: its hull, its name and the horizontal distance between the two hulls, 0 if they touch.
  void judgeMeeting(common::Time now, const QuadrotorState& state, double gap_m, const Actor& other,
                    const std::string& name, Truth& truth) const;

 private:
  void judgeWorld(common::Time now, const QuadrotorState& state, const std::vector<bool>& seen, Truth& truth);
  void judgeWalker(common::Time now, const QuadrotorState& state, const Actor& walker, std::size_t number,
                   Truth& truth) const;
  void judgeDoor(common::Time now, const QuadrotorState& state, const Door& door, Truth& truth) const;
  Eigen::Vector3d hullPointTowards(const Eigen::Vector3d& position_world_m, const Eigen::Vector2d& direction) const;

  const WorldModel& world_;
  const RayCaster& rays_;
  Hull hull_;
  PeopleInField people_;
  Clearance clearance_;
  double gear_radius_m_;
  double lowest_world_m_;
  double floor_world_m_;
  double feet_apart_m_ = 0.0;  ///< Difference of the feet's floor heights at the last call of lookDown().
  int floor_shape_ = Hit::kNothing;
  Eigen::Vector3d last_position_world_m_;
  bool first_ = true;
};

}  // namespace swiftlet::simulation
