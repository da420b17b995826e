// The planning job: brings the cost map up to date and answers one request. It keeps the cost map and the planner's
// search between jobs. While a job is outstanding, only that job may use the worker.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "autonomy/planning_jobs/may_go.hpp"
#include "autonomy/planning_jobs/planning_config.hpp"
#include "autonomy/planning_jobs/planning_request.hpp"
#include "autonomy/planning_jobs/space_planner.hpp"
#include "planning/costs/cost_map.hpp"
#include "planning/exploration/exploration.hpp"
#include "planning/search/planner.hpp"
#include "planning/search/wavefront.hpp"

namespace swiftlet::autonomy {

struct DetourPlan {
  planning::Path path;
  bool makes_room = false;
};

/// Something that may go is in the only way: without it there is one.
struct Blockage {
  Eigen::Vector2d place_map_m = Eigen::Vector2d::Zero();  ///< Where it stands.
  /// With its place: "a person at (4.00, 2.00)"; of an exploration all that are in the way, this one first.
  std::string who;
  int frontiers = 0;  ///< Of an exploration: how many are behind it.
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
  std::shared_ptr<const SpaceMaps> space;  ///< Of a plan in space, as long as such plans are requested; else null.
  std::optional<DetourPlan> detour;        ///< For a DetourRequest; nullopt without a place.
  std::optional<planning::ExplorationResult> exploration;  ///< For an ExploreRequest; `path` leads to its `next`.
  /// Where there is no path to the goal, or no frontier is open; nullopt: it is not blocked only for a time.
  std::optional<Blockage> blockage;
  /// Of an exploration that has nothing open and no blockage: where free space was seen behind a gap that is too
  /// narrow.
  std::optional<Eigen::Vector2d> gap_map_m;
  /// A cell has become free at the edge of what the vehicle could reach when it last found no path.
  bool opened = false;
  std::optional<double> home_m;  ///< Length of the path home; nullopt without a path.
  PlanningUse use;               ///< Totals so far, including this answer.
};

/// Used by one job at a time. An answer depends only on the requests so far.
class PlanningWorker {
 public:
  PlanningWorker(const PlanningConfig& config, double resolution_m, double hull_height_m = 0.25)
      : map_(config.cost_map, resolution_m),
        cleared_(config.cost_map, resolution_m),
        space_(config.lower.enabled, config.cost_map, resolution_m, hull_height_m),
        explorer_(config.explorer),
        planner_(planning::makePlanner(config.planner)),
        prefers_space_(config.planner.kind == planning::PlannerKind::kSampling),
        use_{planner_->name(), 0, toString(config.explorer.kind), 0} {}

  PlanningAnswer answer(const PlanningRequest& request);

 private:
  tl::expected<planning::Path, planning::PlanFailure> plan(const Eigen::Vector2d& from_map_m,
                                                           const Eigen::Vector2d& to_map_m);
  static tl::expected<Eigen::Vector2d, planning::PlanFailure> goalPlace(const planning::CostMap& map,
                                                                        const GoalRequest& goal);
  tl::expected<planning::Path, planning::PlanFailure> goTo(const GoalRequest& goal,
                                                           const Eigen::Vector2d& position_map_m);
  void goInSpace(const PlanningRequest& request, const GoalRequest& goal, const planning::CostLayers& layers,
                 PlanningAnswer& answer);
  std::optional<DetourPlan> detour(const DetourRequest& request, const Eigen::Vector2d& position_map_m);
  void explore(const PlanningRequest& request, const ExploreRequest& question, const planning::CostLayers& layers,
               PlanningAnswer& answer);
  std::vector<MayGo> clear(const PlanningRequest& request, const planning::CostLayers& layers, double spared_m = 0.0);
  std::optional<Blockage> blockageTo(const Eigen::Vector2d& goal_map_m, const Eigen::Vector2d& position_map_m,
                                     const std::vector<MayGo>& things);
  std::optional<Blockage> blockageOf(const planning::Viewpoint& viewpoint, double open_m, const Eigen::Vector2d& here,
                                     const std::vector<MayGo>& things);
  void findBlockage(const PlanningRequest& request, const GoalRequest& goal, const planning::CostLayers& layers,
                    PlanningAnswer& answer);
  void findBlockage(const PlanningRequest& request, planning::ExplorationInput input,
                    const planning::CostLayers& layers, PlanningAnswer& answer);
  void tellBlocked(std::vector<common::Frontier> behind, const Eigen::Vector2d& here, const std::vector<MayGo>& things,
                   PlanningAnswer& answer);
  std::string named(const MayGo& thing) const;
  planning::CostField rememberEdge(const Eigen::Vector2d& position_map_m);
  std::optional<Eigen::Vector2d> gapBefore(const planning::CostField& reached) const;
  std::optional<Eigen::Vector2d> roomyPlace(const Eigen::Vector2d& position_map_m,
                                            const std::optional<Eigen::Vector2d>& seen_map_m,
                                            bool only_if_much_better) const;
  std::optional<double> pathHome_m(const Eigen::Vector2d& position_map_m);

  planning::CostMap map_;
  planning::CostMap cleared_;  ///< The map as if all that may go had gone, as of the last failure.
  WhoMayGo who_may_go_;
  std::vector<common::CellIndex> edge_;  ///< Where the vehicle could not go on when it last found no path.
  SpacePlanner space_;
  std::vector<Eigen::Vector2d> flown_map_m_;  ///< Positions of the vehicle at the requests, thinned.
  planning::ExplorerConfig explorer_;
  std::unique_ptr<planning::Planner> planner_;
  bool prefers_space_;  ///< A path in space replaces one in the plane that is longer.
  planning::Wavefront home_planner_;
  std::optional<double> home_m_;
  int home_failures_ = 0;  ///< Plans without a path, since the last path.
  Eigen::Vector2d home_planned_at_m_ = Eigen::Vector2d::Zero();
  int answers_ = 0;
  PlanningUse use_;
};

}  // namespace swiftlet::autonomy
