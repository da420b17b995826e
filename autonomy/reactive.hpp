// The reactive layer at the laser rate: what moves, how fast one may fly, and when to retreat. It acts below every
// intent.
#pragma once

#include <memory>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/occupancy_grid.hpp"
#include "common/vehicle_state.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/slam2d/slam2d.hpp"
#include "planning/avoidance/avoidance.hpp"
#include "planning/avoidance/dynamic_obstacles.hpp"

namespace swiftlet::autonomy {

struct ReactiveConfig {
  planning::Avoidance::Config avoidance;
  planning::DynamicObstacles::Config dynamic_obstacles;

  void describe(common::config::Fields& fields);
  /// What would stop the vehicle, or make it retreat, on a path planned at this clearance; empty when nothing would.
  std::vector<std::string> problemsWith(double clearance_m) const;
};

/// One thread; update() once a scan.
class Reactive {
 public:
  /// `drawing`: of the grid, which knows only what it says is in the way of the hull.
  Reactive(const ReactiveConfig& config, double hull_radius_m, const perception::GridDrawingConfig& drawing);

  /// `cost_map` may be null before the first plan. `wish_map_m_s` is the velocity the intent wants, zero when it holds.
  const planning::AvoidanceDecision& update(const perception::ProjectedScan& scan, const common::Pose2& T_map_body,
                                            const common::VehicleState& state, const Eigen::Vector2d& wish_map_m_s,
                                            const std::shared_ptr<const common::OccupancyGrid>& grid,
                                            const planning::CostMap* cost_map);

  const planning::AvoidanceDecision& decision() const { return decision_; }
  /// Where those are, in `map`, who were seen just before `stamp`.
  std::vector<planning::Disc> people(common::Time stamp) const;
  bool anybodyWalks() const { return obstacles_.anyMoves(); }
  /// Where people are and will soon be, for the cost map.
  std::vector<planning::Disc> discs(common::Time now) const { return obstacles_.discs(now); }

 private:
  float above_m_, below_m_;  ///< Of the body: the way of the hull.
  planning::Avoidance avoidance_;
  planning::BackgroundMap background_;
  common::Pose2 T_map_odom_;
  planning::DynamicObstacles obstacles_;
  planning::AvoidanceDecision decision_;
};

}  // namespace swiftlet::autonomy
