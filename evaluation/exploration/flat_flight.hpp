// An exploration of a flat building by an ideal vehicle: a point that moves along planned paths with limits of speed,
// acceleration and yaw rate, with an ideal laser and its true pose. Explorer, planner and their maps are those of
// flights; when they are asked is as in the maneuver `Explore`. Seconds of computing compare explorers over a flight of
// minutes; what an estimate, wind and control add is left to flights.
#pragma once

#include <functional>
#include <string>

#include "evaluation/exploration/flat_building.hpp"
#include "planning/costs/cost_map.hpp"
#include "planning/exploration/exploration.hpp"
#include "planning/search/planner_choice.hpp"

namespace swiftlet::evaluation {

struct FlatFlightConfig {
  planning::ExplorerConfig explorer;
  planning::PlannerConfig planner;
  planning::CostMap::Config cost_map;
  planning::Footprint footprint;
  double speed_m_s = 0.73;
  double acceleration_m_s2 = 0.8;
  double corner_deviation_m = 0.08;  ///< From a corner of the path: how far the vehicle may cut it.
  double yaw_rate_rad_s = 1.0;
  double laser_range_m = 30.0;
  double laser_field_of_view_deg = 270.0;
  double limit_s = 3600.0;          ///< Of the exploration.
  std::function<double()> clock_s;  ///< Of the wall, to measure calls; empty: they are not measured.
};

struct FlatFlight {
  bool complete = false;  ///< The explorer said that it is done, and all but 1 % of what the hull can reach was seen.
  std::string failure;    ///< Why it is not, for people.
  double explore_s = 0.0;
  double explore_m = 0.0;
  double total_s = 0.0;  ///< With the flight home.
  double total_m = 0.0;
  double unseen_share = 0.0;    ///< Of the places that the hull can reach with a cell to spare.
  int calls = 0;                ///< Of the explorer.
  int viewpoints = 0;           ///< That were flown to.
  double longest_call_s = 0.0;  ///< Of explorer and planner, by FlatFlightConfig::clock_s.
};

/// Flies from the start until the explorer says that it is done, and home. The same arguments give the same flight but
/// for longest_call_s.
[[nodiscard]] FlatFlight exploreFlat(const FlatBuilding& building, const Eigen::Vector2d& start_m,
                                     const FlatFlightConfig& config);

}  // namespace swiftlet::evaluation
