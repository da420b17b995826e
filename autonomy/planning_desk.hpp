// Where plans are asked for. One planning job is out at a time; each also brings the cost map up to date, which the
// desk sees to by itself when nobody asks for anything.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "autonomy/executor_config.hpp"
#include "autonomy/maneuvers/maneuver_input.hpp"
#include "autonomy/planning_worker.hpp"
#include "common/goal.hpp"
#include "common/jobs.hpp"
#include "common/vehicle_config.hpp"
#include "common/world.hpp"

namespace swiftlet::autonomy {

/// In whose name planning is asked for.
struct PlanningClient {
  std::uint64_t intent_id = 0;
  double clearance_m = 0.0;  ///< Between hull and obstacle; of the cost map too.
};

/// One thread; outlives the jobs it submits.
class PlanningDesk {
 public:
  /// Told of every answer, inside JobRunner::deliverDue(), when the cost map is already the new one.
  using Deliver = std::function<void(const PlanningAnswer&, common::Time now)>;

  PlanningDesk(const ExecutorConfig& config, const common::VehicleConfig& vehicle, double grid_resolution_m,
               common::JobRunner& jobs, Deliver deliver);

  /// No job is out: ask() may be called.
  bool free() const { return jobs_.idle("planning"); }
  void ask(const ManeuverInput& input, const PlanningClient& client, PlanningQuestion question);
  /// Once a tick, after everybody may have asked: keeps the cost map young.
  void refresh(const ManeuverInput& input, const PlanningClient& client);

  /// The newest; null before the first answer.
  std::shared_ptr<const planning::CostMap> costMap() const { return cost_map_; }
  /// The same, for judging goals; null before the first answer.
  std::shared_ptr<const common::GoalMap> goalMap() const { return goal_map_; }
  /// As the last exploration saw them; never null.
  std::shared_ptr<const std::vector<common::Frontier>> frontiers() const { return frontiers_; }
  double exploredArea_m2() const { return explored_area_m2_; }
  /// Who found the paths and chose the viewpoints, by the answers so far.
  const PlanningUse& use() const { return use_; }

 private:
  void receive(const PlanningAnswer& answer, common::Time now);

  double latency_s_, period_s_, hull_radius_m_;
  common::JobRunner& jobs_;
  Deliver deliver_;
  std::shared_ptr<PlanningWorker> worker_;
  std::optional<common::Time> last_request_;
  std::shared_ptr<const planning::CostMap> cost_map_;
  std::shared_ptr<const common::GoalMap> goal_map_;
  std::shared_ptr<const std::vector<common::Frontier>> frontiers_;
  double explored_area_m2_ = 0.0;
  PlanningUse use_;
};

}  // namespace swiftlet::autonomy
