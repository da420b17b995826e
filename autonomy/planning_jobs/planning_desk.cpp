#include "autonomy/planning_jobs/planning_desk.hpp"

#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "planning/exploration/held_path.hpp"
#include "planning/search/goal_map.hpp"

namespace swiftlet::autonomy {
namespace {

/// Time between updates of the cost map, which is never older than this plus the latency.
constexpr double kUpdatePeriod_s = 0.25;

}  // namespace

using common::Time;

PlanningDesk::PlanningDesk(const PlanningConfig& config, const common::VehicleConfig& vehicle, double grid_resolution_m,
                           common::JobRunner& jobs, Deliver deliver)
    : latency_s_(config.latency_s),
      hull_radius_m_(vehicle.hullRadius_m()),
      jobs_(jobs),
      deliver_(std::move(deliver)),
      worker_(std::make_shared<PlanningWorker>(config, grid_resolution_m, vehicle.hull_height_m)),
      frontiers_(std::make_shared<std::vector<common::Frontier>>()) {}

void PlanningDesk::ask(PlanningRequest request, Time now) {
  request.footprint.hull_radius_m = hull_radius_m_;
  last_request_ = now;
  jobs_.submit("planning", now, common::Duration::fromSeconds(latency_s_),
               [this, worker = worker_, request = std::move(request)]() -> common::JobRunner::Deliver {
                 return [this, answer = worker->answer(request)](Time delivered) { receive(answer, delivered); };
               });
}

bool PlanningDesk::due(Time now) const {
  return free() && (!last_request_ || (now - *last_request_).seconds() >= kUpdatePeriod_s);
}

std::shared_ptr<const planning::CostMap> PlanningDesk::costMapAt(const FlightHeights& heights) const {
  constexpr double kSame_m = 0.15;  // Less than the hull is high.
  if (!heights.isOff() || !space_ || !space_->here) return cost_map_;
  if (std::abs(space_->here_height_m - heights.reference_m) > kSame_m) return cost_map_;
  return {space_, &*space_->here};
}

bool PlanningDesk::wallsAround(const common::VehicleState& state) const {
  return !cost_map_ || planning::isHeld(*cost_map_, state.T_map_body_planar().position_m());
}

void PlanningDesk::receive(const PlanningAnswer& answer, Time now) {
  cost_map_ = answer.cost_map;
  goal_map_ = planning::goalMapOf(cost_map_);
  if (answer.space) space_ = answer.space;
  if (answer.exploration) {
    frontiers_ = std::make_shared<std::vector<common::Frontier>>(answer.exploration->frontiers);
    explored_area_m2_ = answer.exploration->explored_area_m2;
  }
  home_m_ = answer.home_m;
  opened_ = answer.opened;
  use_ = answer.use;
  deliver_(answer, now);
}

}  // namespace swiftlet::autonomy
