// Exploration: which frontiers there are, why some of them are not explored, and where to look from next. An explorer
// chooses the viewpoint; a planner finds the path to it.
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

/// A pose to look from.
struct Viewpoint {
  common::Pose2 pose_map;
  Eigen::Vector2d target_map_m = Eigen::Vector2d::Zero();  ///< The unknown place to be seen.
  double gain_m2 = 0.0;                                    ///< Unknown area expected to be seen.
  double utility = 0.0;                                    ///< The viewpoint with the greatest one is chosen.
};

/// An attempt to see an unknown place, and the place it was made from.
struct ExplorationAttempt {
  Eigen::Vector2d target_map_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d place_map_m = Eigen::Vector2d::Zero();
};

struct ExplorationInput {
  std::shared_ptr<const CostMap> cost_map;  ///< Not null. Built with the clearance to be flown; has the grid's states.
  common::Pose2 pose_map;
  std::optional<Viewpoint> current;  ///< The viewpoint being flown to; kept unless another is clearly better.
  std::vector<ExplorationAttempt> attempts;
  std::optional<common::MapBounds> bounds;  ///< Frontiers outside are not explored, nor looked at from outside.
  /// Targets during whose approach the position became uncertain; frontiers near them are not explored.
  std::vector<Eigen::Vector2d> lost_map_m = {};
  /// Whether frontiers with too few walls around to know the position there are explored as well.
  bool leave_building = false;
};

struct ExplorationResult {
  std::vector<common::Frontier> frontiers;  ///< All frontiers, each with its reason; the open ones first, best first.
  std::optional<Viewpoint> next;            ///< nullopt when done, or when the vehicle cannot leave its place.
  bool done = false;                        ///< No frontier is open.
  bool kept_current = false;                ///< `next` is the viewpoint that was given as current.
  double explored_area_m2 = 0.0;            ///< Area of the known free cells.
  /// For people, such as "4 open frontiers, next viewpoint (3.2, 1.5) for 2.0 m2".
  std::string reason;
};

/// Chooses viewpoints. The result depends on the input only. explore() changes nothing, so it can run as a job.
class Explorer {
 public:
  virtual ~Explorer() = default;
  [[nodiscard]] virtual ExplorationResult explore(const ExplorationInput& input) const = 0;
  /// For people, such as "utility".
  virtual const char* name() const = 0;
};

/// The attempt to record once the viewpoint was reached and what is seen from it is in the map.
inline ExplorationAttempt attemptFrom(const Viewpoint& viewpoint) {
  return {viewpoint.target_map_m, viewpoint.pose_map.position_m()};
}

}  // namespace swiftlet::planning
