// The reactive layer at the laser rate: it computes the speed limit, and when to retreat, from the scan, moving people
// and the map. It acts below every intent.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/dynamic_obstacle.hpp"
#include "common/geometry.hpp"
#include "common/vehicle_state.hpp"
#include "perception/projection/scan_projection.hpp"
#include "planning/avoidance/avoidance.hpp"

namespace swiftlet::autonomy {

struct ReactiveConfig {
  planning::Avoidance::Config avoidance;

  void describe(common::config::Fields& fields);
};

/// A scan, with the state at its arrival.
struct ReactiveInput {
  const perception::ProjectedScan& scan;
  common::Pose2 T_map_body;  ///< At the scan's stamp.
  const common::VehicleState& state;
  double age_s = 0.0;    ///< Time since the scan's stamp.
  double drift_m = 0.0;  ///< Standard deviation of the position, grown since the laser fixed it in every direction.
  /// Objects that the map does not explain, usually people, after this scan.
  std::span<const common::DynamicObstacle> obstacles;
  /// The velocity of the intent; zero if it holds.
  Eigen::Vector2d wanted_map_m_s = Eigen::Vector2d::Zero();
  const planning::Clearance* clearance = nullptr;  ///< Null before the first plan.
  /// Obstacles that only the 3D map has, in the level frame of the body.
  std::vector<Eigen::Vector2f> map3d_points_level_m = {};
  /// Of the edges of keep-out zones, in the level frame of the body.
  std::vector<Eigen::Vector2d> keep_out_points_level_m = {};
};

/// One thread; update() once a scan.
class Reactive {
 public:
  Reactive(const ReactiveConfig& config, double hull_radius_m);

  const planning::AvoidanceDecision& update(const ReactiveInput& input);

  /// The last decision; before the first scan the speed is not limited.
  const planning::AvoidanceDecision& decision() const { return decision_; }

 private:
  planning::Avoidance avoidance_;
  planning::AvoidanceDecision decision_;
};

}  // namespace swiftlet::autonomy
