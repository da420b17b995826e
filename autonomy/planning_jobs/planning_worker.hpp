// The planning job: brings the cost map up to date and answers one request. It keeps the cost map and the planner's
// search between jobs. While a job is outstanding, only that job may use the worker.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "autonomy/planning_jobs/lower_planner.hpp"
#include "autonomy/planning_jobs/planning_config.hpp"
#include "autonomy/planning_jobs/planning_request.hpp"
#include "planning/costs/cost_map.hpp"
#include "planning/exploration/exploration.hpp"
#include "planning/search/planner.hpp"
#include "planning/search/wavefront.hpp"

namespace swiftlet::autonomy {

struct DetourPlan {
  planning::Path path;
  bool makes_room = false;
};

/// Names of the planner and the explorer, with the number of their results.
struct PlanningUse {
  std::string planner;
  int paths = 0;  ///< Paths to goals, to viewpoints and of detours.
  std::string explorer;
  int viewpoints = 0;  ///< A viewpoint that was kept is not counted again.
};

struct PlanningAnswer {
  std::uint64_t intent_id = 0;
  std::shared_ptr<const planning::CostMap> cost_map;
  /// For a GoalRequest the path to the goal, for an ExploreRequest the path to the viewpoint it found.
  std::optional<tl::expected<planning::Path, planning::PlanFailure>> path;
  /// The cost maps of a path that is flown at two heights, as long as such paths are requested; else null.
  std::shared_ptr<const planning::TwoHeights> heights;
  std::optional<DetourPlan> detour;                        ///< For a DetourRequest; nullopt without a place.
  std::optional<planning::ExplorationResult> exploration;  ///< For an ExploreRequest; `path` leads to its `next`.
  std::optional<double> home_m;                            ///< Length of the path home; nullopt without a path.
  PlanningUse use;                                         ///< Totals so far, including this answer.
};

/// Used by one job at a time. An answer depends only on the requests so far.
class PlanningWorker {
 public:
  PlanningWorker(const PlanningConfig& config, double resolution_m, double hull_height_m = 0.25)
      : map_(config.cost_map, resolution_m),
        lower_(config.lower.enabled, config.cost_map, resolution_m, hull_height_m),
        explorer_(config.explorer),
        planner_(planning::makePlanner(config.planner)) {}

  PlanningAnswer answer(const PlanningRequest& request);

 private:
  tl::expected<planning::Path, planning::PlanFailure> plan(const Eigen::Vector2d& from_map_m,
                                                           const Eigen::Vector2d& to_map_m);
  tl::expected<Eigen::Vector2d, planning::PlanFailure> goalPlace(const GoalRequest& goal) const;
  tl::expected<planning::Path, planning::PlanFailure> goTo(const GoalRequest& goal,
                                                           const Eigen::Vector2d& position_map_m);
  void goLower(const PlanningRequest& request, const GoalRequest& goal, const planning::CostLayers& layers,
               PlanningAnswer& answer);
  std::optional<DetourPlan> detour(const DetourRequest& request, const std::vector<common::Disc>& people,
                                   const Eigen::Vector2d& position_map_m);
  void explore(const PlanningRequest& request, const ExploreRequest& question, PlanningAnswer& answer);
  std::optional<Eigen::Vector2d> roomyPlace(const Eigen::Vector2d& position_map_m) const;
  std::optional<double> pathHome_m(const Eigen::Vector2d& position_map_m);

  planning::CostMap map_;
  LowerPlanner lower_;
  std::vector<Eigen::Vector2d> flown_map_m_;  ///< Positions of the vehicle at the requests, thinned.
  planning::ExplorerConfig explorer_;
  std::unique_ptr<planning::Planner> planner_;
  planning::Wavefront home_planner_;
  std::optional<double> home_m_;
  int home_failures_ = 0;  ///< Plans without a path, since the last path.
  Eigen::Vector2d home_planned_at_m_ = Eigen::Vector2d::Zero();
  int answers_ = 0;
  int paths_ = 0;       ///< Number of paths that the planner found.
  int viewpoints_ = 0;  ///< Number of viewpoints that the explorer chose.
};

}  // namespace swiftlet::autonomy
