// The planning job: brings the cost map up to date and answers one request. It keeps the cost map and the planner's
// search between jobs; while a job is out, the worker belongs to it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <tl/expected.hpp>

#include "autonomy/executor_config.hpp"
#include "common/level_map.hpp"
#include "common/occupancy_grid.hpp"
#include "planning/costs/cost_map.hpp"
#include "planning/exploration/exploration.hpp"
#include "planning/exploration/explorer_choice.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::autonomy {

struct GoalRequest {
  Eigen::Vector2d goal_map_m = Eigen::Vector2d::Zero();
  double tolerance_m = 0.0;  ///< Of a goal that is too close to something, a place this near will do.
};
struct ExploreRequest {
  std::optional<planning::Viewpoint> current;
  std::vector<planning::ExplorationAttempt> attempts;
  std::optional<common::MapBounds> bounds;
};
/// Where to go while there is no path to a goal. When somebody stands in it: far along free ground and wide, so that he
/// can come past. Otherwise as far towards the goal as it is free, to see whether what the map holds is still there.
struct DetourRequest {
  Eigen::Vector2d goal_map_m = Eigen::Vector2d::Zero();
};

/// Nothing: only the cost map is wanted.
using PlanningQuestion = std::variant<std::monostate, GoalRequest, DetourRequest, ExploreRequest>;

struct PlanningRequest {
  std::uint64_t intent_id = 0;
  std::shared_ptr<const common::OccupancyGrid> grid;
  std::shared_ptr<const common::LevelMap> levels;
  std::vector<common::Disc> discs;
  planning::Footprint footprint;
  common::Pose2 T_map_body;
  PlanningQuestion question;
};

struct DetourPlan {
  planning::Path path;
  bool makes_room = false;
};

/// Who found the paths and chose the viewpoints, and how many.
struct PlanningUse {
  std::string planner;
  int paths = 0;  ///< To goals, to viewpoints and of detours.
  std::string explorer;
  int viewpoints = 0;  ///< A viewpoint that was kept is not counted again.
};

struct PlanningAnswer {
  std::uint64_t intent_id = 0;
  std::shared_ptr<const planning::CostMap> cost_map;
  /// For a GoalRequest, and to the viewpoint that an ExploreRequest found.
  std::optional<tl::expected<planning::Path, planning::PlanFailure>> path;
  std::optional<DetourPlan> detour;                        ///< For a DetourRequest, when there is anywhere to go.
  std::optional<planning::ExplorationResult> exploration;  ///< For an ExploreRequest; a `next` in it has its path.
  PlanningUse use;                                         ///< So far, this answer included.
};

/// One job at a time; a pure function of the requests so far.
class PlanningWorker {
 public:
  PlanningWorker(const ExecutorConfig& config, double resolution_m)
      : map_(config.cost_map, resolution_m),
        explorer_(planning::makeExplorer(config.explorer, config.exploration)),
        planner_(planning::makePlanner(config.planner)) {}

  PlanningAnswer answer(const PlanningRequest& request);

 private:
  tl::expected<planning::Path, planning::PlanFailure> plan(const Eigen::Vector2d& from_map_m,
                                                           const Eigen::Vector2d& to_map_m);
  tl::expected<planning::Path, planning::PlanFailure> goTo(const GoalRequest& goal,
                                                           const Eigen::Vector2d& position_map_m);
  std::optional<DetourPlan> detour(const DetourRequest& request, const std::vector<common::Disc>& people,
                                   const Eigen::Vector2d& position_map_m);
  void explore(const PlanningRequest& request, const ExploreRequest& question, PlanningAnswer& answer);
  std::optional<Eigen::Vector2d> roomyPlace(const Eigen::Vector2d& position_map_m) const;

  planning::CostMap map_;
  std::vector<Eigen::Vector2d> flown_map_m_;  ///< Where the vehicle was at the requests.
  std::unique_ptr<planning::Explorer> explorer_;
  std::unique_ptr<planning::Planner> planner_;
  int paths_ = 0;       ///< Found by the planner.
  int viewpoints_ = 0;  ///< Chosen by the explorer.
};

}  // namespace swiftlet::autonomy
