// Exploration: what is left to see, why each rest is left, and where to look from next. An explorer chooses the
// viewpoint; the path there is found by a planner.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/intent.hpp"
#include "common/world/frontier.hpp"
#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {

/// Where to look from.
struct Viewpoint {
  common::Pose2 pose_map;
  Eigen::Vector2d target_map_m = Eigen::Vector2d::Zero();  ///< The unknown place it is for.
  double gain_m2 = 0.0;                                    ///< Unknown area expected to be seen.
  double utility = 0.0;                                    ///< Of several viewpoints the greatest is chosen.
};

/// A look at an unknown place that stayed unknown, and from where.
struct ExplorationAttempt {
  Eigen::Vector2d target_map_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d place_map_m = Eigen::Vector2d::Zero();
};

struct ExplorationInput {
  std::shared_ptr<const CostMap> cost_map;  ///< Not null. Built at the clearance to be flown; holds the grid's states.
  common::Pose2 pose_map;
  std::optional<Viewpoint> current;  ///< The one being flown to; kept unless another is clearly better.
  std::vector<ExplorationAttempt> attempts;
  std::optional<common::MapBounds> bounds;  ///< What lies outside is left.
};

struct ExplorationResult {
  std::vector<common::Frontier> frontiers;  ///< All of them, each with its reason; open ones best first.
  std::optional<Viewpoint> next;            ///< None when done, or when the vehicle itself is shut in.
  bool done = false;                        ///< No frontier is open: each has its reason.
  bool kept_current = false;                ///< `next` goes on with the viewpoint that was given as current.
  double explored_area_m2 = 0.0;            ///< Of known free cells.
  std::string reason;                       ///< For people: "4 open frontiers, next 3.2 m away".
};

/// Chooses viewpoints. Constant: what it answers follows from the input alone; run it as a job.
class Explorer {
 public:
  virtual ~Explorer() = default;
  [[nodiscard]] virtual ExplorationResult explore(const ExplorationInput& input) const = 0;
  /// "utility".
  virtual const char* name() const = 0;
};

/// The viewpoint was reached and what is seen from it is in the map.
inline ExplorationAttempt attemptFrom(const Viewpoint& viewpoint) {
  return {viewpoint.target_map_m, viewpoint.pose_map.position_m()};
}

}  // namespace swiftlet::planning
