// One question of `swiftlet plan`, answered by any planner in any map.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "apps/plan_map.hpp"
#include "common/occupancy_grid.hpp"

namespace swiftlet::apps {

enum class PlannerName { kDStar, kWavefront, kSampling };

struct PlanQuestion {
  PlannerName planner = PlannerName::kDStar;
  Eigen::Vector3d start_map_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal_map_m = Eigen::Vector3d::Zero();
  double hull_radius_m = 0.275;
  double hull_height_m = 0.25;
  double clearance_m = 0.10;  ///< Between the hull and what is in the way.
  int seed = 0;
};

/// Either a path of at least one point or a refusal.
struct PlanAnswer {
  std::vector<Eigen::Vector3d> points_map_m;
  double length_m = 0.0;
  double clearance_m = 0.0;        ///< Least distance of the hull's axis along the path.
  bool clearance_is_more = false;  ///< The clearance is at least that.
  std::string refusal;
  std::optional<Eigen::Vector3d> nearest_map_m;  ///< To the goal, or of a start that is refused.
  std::size_t nodes = 0;                         ///< Cells or states that the search took.
  double map_s = 0.0, search_s = 0.0;            ///< Wall-clock time.
  common::OccupancyGrid plane =
      common::makeOccupancyGrid(1.0);  ///< What is drawn; a space's at the heights of the path.
};

PlanAnswer answer(const PlanMap& map, const PlanQuestion& question);

}  // namespace swiftlet::apps
