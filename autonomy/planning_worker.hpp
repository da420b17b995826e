// The planning job: brings the cost map up to date and answers one request. It keeps the cost map and the D* Lite
// search between jobs; while a job is out, the worker belongs to it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <tl/expected.hpp>

#include "common/disc.hpp"
#include "common/level_map.hpp"
#include "common/occupancy_grid.hpp"
#include "planning/costs/cost_map.hpp"
#include "planning/exploration/exploration.hpp"
#include "planning/search/planner.hpp"
#include "planning/search/planner_choice.hpp"

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

/// Who found the paths, and how many.
struct PlannerUse {
  std::string planner;
  int paths = 0;
};

struct PlanningAnswer {
  std::uint64_t intent_id = 0;
  std::shared_ptr<const planning::CostMap> cost_map;
  std::optional<tl::expected<planning::Path, planning::PlanFailure>> path;  ///< For a GoalRequest.
  std::optional<DetourPlan> detour;                        ///< For a DetourRequest, when there is anywhere to go.
  std::optional<planning::ExplorationResult> exploration;  ///< For an ExploreRequest.
  PlannerUse use;                                          ///< So far, this answer included.
};

/// One job at a time; a pure function of the requests so far.
class PlanningWorker {
 public:
  PlanningWorker(const planning::CostMap::Config& cost_map, const planning::ExplorationConfig& exploration,
                 const planning::PlannerConfig& planner, double resolution_m)
      : exploration_(exploration), map_(cost_map, resolution_m), planner_(planning::makePlanner(planner)) {}

  PlanningAnswer answer(const PlanningRequest& request);

 private:
  tl::expected<planning::Path, planning::PlanFailure> plan(const Eigen::Vector2d& from_map_m,
                                                           const Eigen::Vector2d& to_map_m);
  tl::expected<planning::Path, planning::PlanFailure> goTo(const GoalRequest& goal,
                                                           const Eigen::Vector2d& position_map_m);
  std::optional<DetourPlan> detour(const DetourRequest& request, const std::vector<common::Disc>& people,
                                   const Eigen::Vector2d& position_map_m);
  std::optional<Eigen::Vector2d> roomyPlace(const Eigen::Vector2d& position_map_m) const;

  planning::ExplorationConfig exploration_;
  planning::CostMap map_;
  std::vector<Eigen::Vector2d> flown_map_m_;  ///< Where the vehicle was at the requests.
  std::unique_ptr<planning::Planner> planner_;
  int paths_ = 0;  ///< Found by the planner.
};

}  // namespace swiftlet::autonomy
