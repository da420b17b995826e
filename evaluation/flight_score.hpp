// The figures of one flight, and whether they are good enough.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/machine_use.hpp"
#include "evaluation/behavior_score.hpp"
#include "evaluation/criteria.hpp"
#include "evaluation/flight_recorder.hpp"
#include "evaluation/map3d_score.hpp"
#include "evaluation/marker_errors.hpp"
#include "evaluation/true_world.hpp"
#include "evaluation/verdict.hpp"

namespace swiftlet::evaluation {

/// How a flight localized in the map it was given.
struct LocalizationScore {
  std::optional<double> path_length_m;  ///< Path flown until it first reported a pose.
  std::optional<double> error_m;
  std::optional<double> error_rad;
  bool in_time = false;      ///< The first pose was right, and came within Criteria::localized_within_m.
  double time_share = 0.0;   ///< Share of the flight in which it was localized.
  double wrong_share = 0.0;  ///< Share of the localized time in which the pose was wrong.
  int times_lost = 0;
};

/// How the vehicle was flown.
struct ConductScore {
  std::optional<double> tilted_share;           ///< Share of the time in the air with a tilt of more than 10 degrees.
  std::optional<double> tilt_max_deg;           ///< Greatest tilt in the air.
  std::optional<double> thrust_margin_min;      ///< Thrust at 95 % throttle over the weight, at the least charge.
  std::optional<double> touch_down_speed_m_s;   ///< Greatest speed of descent at a touch-down.
  std::optional<double> safe_action_s;          ///< Longest time from a fault to holding, landing or standing.
  std::optional<double> home_energy_predicted;  ///< Share of the full battery for the flight home, by the vehicle.
  std::optional<double> home_energy_needed;     ///< Share that the flight home took, by the truth.
  std::optional<double> home_energy_error;      ///< |predicted - needed| / needed.
  std::optional<double> laser_latency_median_s;
  std::optional<double> laser_latency_p95_s;
};

/// An optional figure is nullopt if it could not be measured, for example if no goal was reached.
struct FlightScore {
  std::int64_t seed = 0;
  std::string vehicle;         ///< Name of the vehicle among several that flew together; empty: it flew alone.
  std::string folder;          ///< Of the run, relative to the trial's; set by the caller.
  std::string outcome;         ///< "done", or why not.
  bool mission_begun = false;  ///< Otherwise there is no mission_time_s.
  bool mission_done = false;
  Verdict verdict = Verdict::kUnfinished;
  std::string verdict_reason;  ///< Reason by the truth, with figures.

  std::optional<double> coverage;      ///< Share of the free space that the hull can cover, at the mission's clearance.
  std::string coverage_problem;        ///< Why there is no coverage: the world is not closed.
  std::optional<double> goal_error_m;  ///< The worst error of the mission's goals.
  std::optional<double> home_error_m;
  std::vector<MarkerVisit> visits;               ///< Every goal that was reached.
  std::optional<double> marker_error_m;          ///< Worst error of the estimate at a goal.
  std::optional<double> relocalization_error_m;  ///< Worst difference between visits of the same goal.
  /// Worst error of the odometry from one visit to the next of the same goal.
  std::optional<double> open_loop_error_m;
  /// Horizontal, against the truth in the frame that the vehicle can know, without alignment.
  std::optional<double> estimate_rms_m;
  std::optional<double> estimate_spatial_rms_m;
  std::optional<double> estimate_yaw_rms_rad;
  std::optional<double> map_wall_error_median_m;
  std::optional<double> map_wall_error_p95_m;
  /// Errors in the frame of the take-off with the true heading of the body: the mount's yaw counts as an error.
  std::optional<double> goal_error_raw_m;
  std::optional<double> home_error_raw_m;
  std::optional<double> estimate_rms_raw_m;
  std::optional<double> map_wall_error_median_raw_m;
  ConductScore conduct;
  BehaviorScore behaviors;
  std::optional<LocalizationScore> localization;       ///< nullopt without a given map.
  std::optional<Map3dScore> map3d;                     ///< nullopt without a 3D map.
  std::optional<VisualOdometryScore> visual_odometry;  ///< nullopt unless the trial requires it.

  int collisions = 0;
  /// Collisions that the verdict does not excuse, as it does forced ones, glass that no beam had seen, and walkers that
  /// ran into a vehicle that stood still or moved away.
  int avoidable_collisions = 0;
  int glass_contacts = 0;        ///< Collisions with glass that had never returned a beam.
  std::string collision;         ///< What was touched; empty if nothing was.
  double min_clearance_m = 0.0;  ///< Least distance from the hull while airborne; capped by the simulator.
  double min_walker_clearance_m = 0.0;

  double mission_time_s = 0.0;
  double flight_time_s = 0.0;              ///< Simulated time.
  double distance_m = 0.0;                 ///< True distance.
  double end_distance_m = 0.0;             ///< True horizontal distance from the take-off place at the end.
  double speed_max_m_s = 0.0;              ///< True horizontal speed.
  std::optional<double> explored_area_m2;  ///< nullopt if the mission did not explore.
  double reachable_area_m2 = 0.0;          ///< Area that the hull can cover; `coverage` is a share of it.
  std::vector<PhaseScore> phases;
  std::vector<OperatorAnswer> operator_answers;
  int interruptions = 0;
  int resumed = 0;
  double realtime_factor = 0.0;
  common::MachineUse machine;

  /// Every criterion that was missed, with figure and bound. A collision that is excused, or that is judged over all
  /// flights, is not among them.
  std::vector<std::string> failures;
  /// No flight passes that ended in a collision, whoever is to blame for it.
  bool passed() const { return failures.empty() && collisions == 0; }
};

/// `wall_time_s` is the computing time; 0 if not known.
FlightScore scoreOf(const FlightRecord& record, const TrueWorld& world, const Criteria& criteria, std::int64_t seed,
                    double wall_time_s, const common::MachineUse& machine = {});

/// The figures of how the vehicle was flown, by their names in results.json.
std::vector<std::pair<const char*, std::optional<double>>> figuresOf(const ConductScore& score);

/// The measured figures by their names in results.json, for the report of the flight; coverage is stored separately
/// there.
std::vector<std::pair<std::string, double>> figuresOf(const FlightScore& score);

/// The criteria of one flight that it misses; for those over all flights see TrialResult::missed().
std::vector<std::string> missed(const FlightScore& score, const Criteria& criteria);

}  // namespace swiftlet::evaluation
