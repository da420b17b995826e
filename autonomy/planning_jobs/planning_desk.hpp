// Runs plans as jobs, one at a time. Each job also updates the cost map. If no plan is requested for a while, the desk
// submits a job that only updates the cost map.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "autonomy/planning_jobs/planning_config.hpp"
#include "autonomy/planning_jobs/planning_worker.hpp"
#include "common/goal.hpp"
#include "common/jobs.hpp"
#include "common/vehicle_config.hpp"
#include "common/vehicle_state.hpp"
#include "common/world.hpp"

namespace swiftlet::autonomy {

/// One thread; outlives the jobs it submits.
class PlanningDesk {
 public:
  /// Called with every answer when its job is delivered; costMap() is then already the new one.
  using Deliver = std::function<void(const PlanningAnswer&, common::Time now)>;

  PlanningDesk(const PlanningConfig& config, const common::VehicleConfig& vehicle, double grid_resolution_m,
               common::JobRunner& jobs, Deliver deliver);

  double hullRadius_m() const { return hull_radius_m_; }
  /// True if no job is outstanding, so that ask() may be called.
  bool free() const { return jobs_.idle("planning"); }
  /// The desk sets the radius of the hull: the radius of the request is ignored.
  void ask(PlanningRequest request, common::Time now);
  /// True if no job is outstanding and the last request is 0.25 s old: a request is due, if only to update
  /// the cost map.
  bool due(common::Time now) const;

  /// The newest cost map; null before the first answer.
  std::shared_ptr<const planning::CostMap> costMap() const { return cost_map_; }
  /// The newest cost map of the height at which the vehicle is; null before the first answer.
  std::shared_ptr<const planning::CostMap> costMapAt(const FlightHeights& heights) const;
  /// Whether the map has enough walls around the vehicle to know the position there; true without a map.
  bool wallsAround(const common::VehicleState& state) const;
  /// What the newest path in space was planned with; null before the first request of such a path.
  std::shared_ptr<const SpaceMaps> space() const { return space_; }
  /// The newest cost map for judging goals; null before the first answer.
  std::shared_ptr<const common::GoalMap> goalMap() const { return goal_map_; }
  /// The frontiers found by the last exploration request; never null.
  std::shared_ptr<const std::vector<common::Frontier>> frontiers() const { return frontiers_; }
  double exploredArea_m2() const { return explored_area_m2_; }
  /// Length of the path home, as planned a few answers ago; nullopt without a path.
  const std::optional<double>& home_m() const { return home_m_; }
  /// PlanningAnswer::opened of the last answer.
  bool opened() const { return opened_; }
  /// The planner and the explorer in use, with the number of their results so far.
  const PlanningUse& use() const { return use_; }

 private:
  void receive(const PlanningAnswer& answer, common::Time now);

  double latency_s_, hull_radius_m_;
  common::JobRunner& jobs_;
  Deliver deliver_;
  std::shared_ptr<PlanningWorker> worker_;
  std::optional<common::Time> last_request_;
  std::shared_ptr<const planning::CostMap> cost_map_;
  std::shared_ptr<const SpaceMaps> space_;
  std::shared_ptr<const common::GoalMap> goal_map_;
  std::shared_ptr<const std::vector<common::Frontier>> frontiers_;
  double explored_area_m2_ = 0.0;
  std::optional<double> home_m_;
  bool opened_ = false;
  PlanningUse use_;
};

}  // namespace swiftlet::autonomy
