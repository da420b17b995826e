// The figures of one flight, and whether they are good enough.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/vehicle_config.hpp"
#include "evaluation/flight_recorder.hpp"
#include "evaluation/marker_errors.hpp"
#include "simulation/ray_caster.hpp"

namespace swiftlet::evaluation {

/// What a flight, and all flights of a trial together, must reach to pass. What is left at its default is not asked
/// for, but for the first two.
struct Criteria {
  static constexpr double kAny = std::numeric_limits<double>::infinity();

  bool mission_done = true;
  int collisions_max = 0;
  double coverage_min = 0.0;
  double goal_error_max_m = kAny;
  double home_error_max_m = kAny;
  double marker_error_max_m = kAny;
  double relocalization_error_max_m = kAny;
  double mission_time_max_s = kAny;
  double estimate_rms_max_m = kAny;
  double map_wall_error_max_m = kAny;
  double localized_within_m = kAny;
  double wrong_time_share_max = kAny;
  bool all_resumed = true;
  double goal_error_median_max_m = kAny;
  double home_error_median_max_m = kAny;
  double mission_time_median_max_s = kAny;
  double estimate_rms_median_max_m = kAny;
  double map_wall_error_median_max_m = kAny;
  double localized_flights_min = 0.0;

  void describe(common::config::Fields& fields);
};

/// How a flight found itself in the map it was given.
struct LocalizationScore {
  std::optional<double> path_length_m;  ///< Flown until it first said where it is, and how far off that was.
  std::optional<double> error_m;
  std::optional<double> error_rad;
  bool in_time = false;      ///< It was right, and within Criteria::localized_within_m.
  double time_share = 0.0;   ///< Of the flight, localized,
  double wrong_share = 0.0;  ///< and of that, wrongly.
  int times_lost = 0;
};

/// An optional figure is none where it could not be measured: no goal was reached, nothing flew.
struct FlightScore {
  std::int64_t seed = 0;
  std::string vehicle;  ///< Its name among several that flew together; empty: it flew alone.
  std::string folder;   ///< Of the run, relative to the trial's; set by the caller.
  std::string outcome;  ///< "done", or why not.
  bool mission_done = false;

  std::optional<double> coverage;      ///< Of the free space the hull can cover, at the mission's clearance.
  std::string coverage_problem;        ///< Why there is none: the world is not closed.
  std::optional<double> goal_error_m;  ///< The worst of the mission's goals.
  std::optional<double> home_error_m;
  std::vector<MarkerVisit> visits;               ///< Every goal reached; the worst of the flight's follow.
  std::optional<double> marker_error_m;          ///< Of the estimate, at a goal.
  std::optional<double> relocalization_error_m;  ///< Between visits of the same goal.
  std::optional<double> open_loop_error_m;       ///< Of the odometry, from one visit to the next of the same goal.
  std::optional<double> estimate_rms_m;          ///< Horizontal, against the truth in the true map frame: no alignment.
  std::optional<double> estimate_spatial_rms_m;
  std::optional<double> estimate_yaw_rms_rad;
  std::optional<double> map_wall_error_median_m;
  std::optional<double> map_wall_error_p95_m;
  std::optional<LocalizationScore> localization;  ///< None: the flight was given no map.

  int collisions = 0;
  int avoidable_collisions = 0;  ///< Not those where a walker ran into a vehicle that stood still or made way.
  std::string collision;         ///< What was touched; empty when nothing was.
  double min_clearance_m = 0.0;  ///< From the hull, while airborne; capped by the simulator.
  double min_walker_clearance_m = 0.0;

  double mission_time_s = 0.0;
  double flight_time_s = 0.0;              ///< Simulated.
  double distance_m = 0.0;                 ///< True.
  double speed_max_m_s = 0.0;              ///< True, horizontal.
  std::optional<double> explored_area_m2;  ///< None: the mission did not explore.
  double reachable_area_m2 = 0.0;          ///< That the hull can cover; `coverage` is a share of it.
  int interruptions = 0;
  int resumed = 0;
  double realtime_factor = 0.0;

  std::vector<std::string> failures;  ///< Every criterion that was missed, with figure and bound; empty: passed.
  bool passed() const { return failures.empty(); }
};

/// Where a trial says nothing else.
inline constexpr double kClearance_m = 0.10;
inline constexpr double kReachableAreaMax_m2 = 2000.0;

/// What the scorer needs to know of the world as it was for this flight, after the seed's variation.
struct TrueWorld {
  const simulation::RayCaster* rays = nullptr;
  common::VehicleConfig vehicle;
  common::LaserConfig laser;
  double clearance_m = kClearance_m;  ///< The mission's: where hull and clearance do not fit, nobody expects it to go.
  double reachable_area_max_m2 = kReachableAreaMax_m2;  ///< A world where it gets to more than this is taken for open.
};

/// `wall_time_s` is how long the machine took; 0: not known.
FlightScore scoreOf(const FlightRecord& record, const TrueWorld& world, const Criteria& criteria, std::int64_t seed,
                    double wall_time_s);

/// The measured figures by the names of results.json, for the report of the flight; coverage has a place of its own
/// there.
std::vector<std::pair<std::string, double>> figuresOf(const FlightScore& score);

/// The criteria of one flight that it misses; those over all flights are TrialResult::missed().
std::vector<std::string> missed(const FlightScore& score, const Criteria& criteria);

}  // namespace swiftlet::evaluation
