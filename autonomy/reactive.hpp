// The reactive layer at the laser rate: how fast one may fly, and when to retreat, from what the laser sees, from those
// who move and from the map. It acts below every intent.
#pragma once

#include <span>

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

/// A scan, and what is known when it comes.
struct ReactiveInput {
  const perception::ProjectedScan& scan;
  common::Pose2 T_map_body;  ///< At the scan's stamp.
  const common::VehicleState& state;
  std::span<const common::DynamicObstacle> obstacles;        ///< People above all, after this scan.
  Eigen::Vector2d wanted_map_m_s = Eigen::Vector2d::Zero();  ///< The velocity the intent wants; zero when it holds.
  const planning::CostMap* cost_map = nullptr;               ///< Null before the first plan.
};

/// One thread; update() once a scan.
class Reactive {
 public:
  Reactive(const ReactiveConfig& config, double hull_radius_m);

  const planning::AvoidanceDecision& update(const ReactiveInput& input);

  /// The last one; before the first scan nothing limits the speed.
  const planning::AvoidanceDecision& decision() const { return decision_; }

 private:
  planning::Avoidance avoidance_;
  planning::AvoidanceDecision decision_;
};

}  // namespace swiftlet::autonomy
