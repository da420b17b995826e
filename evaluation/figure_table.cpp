// The table of the figures of a flight: one row each, in groups.
#include <utility>

#include "evaluation/criteria.hpp"
#include "evaluation/figure_rows.hpp"

namespace swiftlet::evaluation {
namespace {

using Figures = std::vector<FlightFigure>;

template <Verdict kVerdict>
Value is(const FlightScore& flight) {
  return flight.verdict == kVerdict ? 1.0 : 0.0;
}

template <auto kMember>
Value ofMachine(const FlightScore& flight) {
  return flight.machine.*kMember;
}

Figures verdictRows() {
  return {
      row("done",
          mean("done_share", percent("done"),
               atLeast("done_share_min", "share of flights done", "Least share of all flights that did their mission.",
                       kIfMeasured)),
          follows(is<Verdict::kDone>)),
      row("needless",
          mean("needless_share", percent("needless"),
               atMost("needless_share_max", "share of flights that landed or refused needlessly",
                      "With verdicts, greatest share of all flights that landed or refused without a reason that "
                      "the truth confirms.",
                      kIfMeasured, Bounds{0, 1})),
          follows(is<Verdict::kNeedless>)),
  };
}

/// Share of the free space that the hull can cover, at the mission's clearance.
Figures coverageRows() {
  return {row("coverage", percent("coverage"),
              atLeast("coverage_min", "coverage", "Least share of the reachable free space that is in the map."),
              least("coverage_min", always(percent("coverage min"))))};
}

/// The worst error of the goals that were reached, of home, and of the estimate there: marker_errors.hpp.
Figures goalRows() {
  return {
      row("goal_error_m", column("goal err (m)"),
          atMost("goal_error_max_m", "goal error, m",
                 "Greatest distance of the vehicle from a goal that is reported as reached."),
          greatest("goal_error_max_m", always(column("goal err max (m)"))),
          median("goal_error_median_m", always(column("median (m)")),
                 atMost("goal_error_median_max_m", "goal error median, m",
                        "Greatest median of all flights' goal errors."))),
      row("home_error_m", column("home err (m)"),
          atMost("home_error_max_m", "home error, m",
                 "Greatest distance of the vehicle from home when that is reported as reached."),
          greatest("home_error_max_m", always(column("home err max (m)"))),
          median("home_error_median_m", always(column("median (m)")),
                 atMost("home_error_median_max_m", "home error median, m",
                        "Greatest median of all flights' home errors."))),
      row("marker_error_m",
          atMost("marker_error_max_m", "marker error, m",
                 "Greatest error of the estimate when a goal or home is reported as reached."),
          greatest("marker_error_max_m", column("marker err max (m)")), median("marker_error_median_m")),
      row("relocalization_error_m",
          atMost("relocalization_error_max_m", "relocalization error, m",
                 "Greatest difference between the estimate's errors at the same goal at different times."),
          greatest("relocalization_error_max_m", column("relocalization max (m)")),
          median("relocalization_error_median_m")),
      row("open_loop_error_m"),
  };
}

/// A mission that never began has no time.
Figures missionRows() {
  return {
      row("mission_time_s", kOrZero, column("time (s)", 1),
          atMost("mission_time_max_s", "mission time, s", "Greatest simulated time of the mission.")),
      row("done_mission_time_s", kNot,
          median("mission_time_median_s", always(column("time median (s)", 1)),
                 atMost("mission_time_median_max_s", "mission time median, s",
                        "Greatest median of the times of all missions that ended well.", kIfMeasured)),
          follows([](const FlightScore& flight) -> Value {
            return flight.mission_done ? flight.figure("mission_time_s") : std::nullopt;
          })),
  };
}

/// True and horizontal.
Figures distanceRows() {
  return {row("distance_m", column("distance (m)", 1),
              atLeast("unfinished_distance_min_m", "distance flown without having done the mission, m",
                      "Least distance flown by a vehicle that ends without having done its mission.", kOfUndone,
                      Bounds{0, 1e5}),
              median("distance_median_m"))};
}

Figures flightTimeRows() { return {row("flight_time_s", median("flight_time_median_s"))}; }

Figures courseRows() {
  return {
      row("end_distance_m",
          atMost("end_distance_max_m", "distance from the take-off place at the end, m",
                 "Greatest horizontal distance from the take-off place at which the vehicle is at the end.", kAlways)),
      row("speed_max_m_s"),
      row("floor_contact_s"),
      row("explored_area_m2"),
  };
}

/// The area that the hull can cover, of which the coverage is a share.
Figures spaceRows() { return {row("reachable_area_m2", kOrZero)}; }

/// Against the truth in the frame that the vehicle can know, without alignment.
Figures estimateRows() {
  return {
      row("estimate_rms_m", column("estimate RMS (m)"),
          atMost("estimate_rms_max_m", "estimate RMS, m", "Greatest RMS of the estimate's horizontal error."),
          median("estimate_rms_median_m", always(column("RMS median (m)")),
                 atMost("estimate_rms_median_max_m", "estimate RMS median, m",
                        "Greatest median of all flights' RMS errors."))),
      row("end_error_share", column("end err / path", 4),
          median("end_error_share_median", column("end err / path", 4),
                 atMost("end_error_share_median_max", "error at the end over the path, median",
                        "Greatest median of all flights' horizontal errors of the estimate at the end, as shares of "
                        "the flown paths."))),
      row("estimate_spatial_rms_m", atMost("estimate_spatial_rms_max_m", "estimate RMS in space, m",
                                           "Greatest RMS of the estimate's error in space, the height's included.")),
      row("height_error_m",
          atMost("estimate_height_error_max_m", "error of the height, m",
                 "Greatest error of the height over the take-off floor while it was said to be known."),
          greatest("height_error_max_m", column("height err max (m)"))),
      row("estimate_yaw_rms_rad"),
      row("position_outside_share",
          mean("position_outside_share", percent("outside 3.5 sigma"),
               atMost("position_outside_share_max", "share of the time outside of the covariance",
                      "Greatest share of the time in which the horizontal position is more than a Mahalanobis distance "
                      "of 3.5 from the truth, by the covariance of the estimate, mean of the flights.",
                      kIfMeasured))),
      row("position_mahalanobis_mean_square", column("Mahalanobis2", 2),
          mean("position_mahalanobis_mean_square", column("Mahalanobis2", 2),
               atMost("position_mahalanobis_mean_square_max", "mean square of the Mahalanobis distance",
                      "Greatest mean square of that distance, mean of the flights; it is 2 where the covariance is "
                      "right.",
                      kIfMeasured)),
          mean("position_mahalanobis_mean_square_least", {},
               atLeast("position_mahalanobis_mean_square_min", "least mean square of the Mahalanobis distance",
                       "Least mean square of that distance, mean of the flights: less is an inflated covariance.",
                       kIfMeasured, Bounds{0, 2}))),
      row("map_wall_error_median_m", column("wall err (m)"),
          atMost("map_wall_error_max_m", "map wall error, m", "Greatest median distance of mapped walls to true ones."),
          median("map_wall_error_median_m", always(column("wall err median (m)")),
                 atMost("map_wall_error_median_max_m", "map wall error median, m",
                        "Greatest median of all flights' wall errors."))),
      row("map_wall_error_p95_m"),
  };
}

/// Distance of the cloud to the nearest surface, cloud_metrics.hpp: the map where the vehicle can know it to be, and
/// after one rigid motion of the whole cloud.
Figures map3dRows() {
  return {
      row("map3d_points", key("points"), kCount),
      row("map3d_error_median_m", key("error_median_m"),
          atMost("map3d_error_max_m", "3D map error, m",
                 "Greatest median distance of the 3D map's cubes of 10 cm to true surfaces, the map as it stands."),
          median("map3d_error_median_m"), greatest("map3d_error_max_m", column("3D map err max (m)"))),
      row("map3d_error_p95_m", key("error_p95_m")),
      row("map3d_aligned_median_m", key("aligned_median_m"),
          atMost("map3d_aligned_error_max_m", "3D map error aligned, m",
                 "Greatest median distance of the 3D map's cubes of 10 cm to true surfaces, after one rigid motion "
                 "of all of them."),
          greatest("map3d_aligned_error_max_m", column("aligned (m)"))),
      row("map3d_aligned_p95_m", key("aligned_p95_m"),
          atMost("map3d_aligned_p95_max_m", "3D map error aligned of 95 %, m",
                 "Greatest distance within which 95 % of the 3D map's cubes of 10 cm are, after one rigid motion of "
                 "all of them."),
          greatest("map3d_aligned_p95_max_m", column("aligned 95 % (m)"))),
      row("map3d_coverage", key("coverage"),
          atLeast(
              "map3d_coverage_min", "3D map coverage",
              "Least share of the surfaces in view of the RGB-D camera that have points of the 3D map within 10 cm."),
          least("map3d_coverage_min", percent("3D coverage min"))),
  };
}

/// What the flight knew at its end of the camera's mount, and what its data sheet says of it, as angles to the true
/// one; and of the camera's clock.
Figures cameraRows() {
  return {row("camera_mount_error_rad", key("mount_rad")),
          row("camera_mount_error_of_data_sheet_rad", key("sheet_rad")), row("camera_clock_error_s", key("clock_s"))};
}

Figures visualOdometryRows() {
  return {row("visual_odometry_rms_m", key("rms_m"), median("visual_odometry_rms_median_m")),
          row("visual_odometry_lost_share", key("lost_share"), greatest("visual_odometry_lost_share_max"))};
}

/// In the map that the flight was given. Localized in time: the first pose was right, and came within
/// Criteria::localized_within_m.
Figures localizationRows() {
  return {
      row("localized_in_time", key("in_time"), kFlag,
          mean("localized_flights", percent("localized"),
               atLeast("localized_flights_min", "flights localized", "Least share of all flights that were localized.",
                       kIfMeasured, Bounds{0, 1}, "no flight was given a map"))),
      row("localization_path_length_m", key("path_length_m"),
          median("localization_path_length_median_m", column("after, median (m)", 1)),
          greatest("localization_path_length_max_m")),
      row("localization_error_m", key("error_m")),
      row("localization_error_rad", key("error_rad")),
      row("localized_time_share", key("time_share")),
      row("wrong_time_share", key("wrong_share"),
          atMost("wrong_time_share_max", "share of the time localized wrongly",
                 "Greatest share of the time localized in which the estimate is farther than 0.5 m or 10 deg from "
                 "the truth."),
          greatest("wrong_time_share_max", percent("wrongly, of its time"))),
      row("times_lost", key("times_lost"), kCount),
  };
}

/// In the frame of the take-off with the true heading of the body: the mount's yaw counts as an error. The summary
/// shows them below the figures of the same name without `raw`.
Figures rawFrameRows() {
  return {row("goal_error_raw_m", column("raw goal err (m)"), greatest("goal_error_max_raw_m"),
              median("goal_error_median_raw_m")),
          row("home_error_raw_m", column("raw home err (m)"), greatest("home_error_max_raw_m"),
              median("home_error_median_raw_m")),
          row("estimate_rms_raw_m", column("raw RMS (m)"), median("estimate_rms_median_raw_m")),
          row("map_wall_error_median_raw_m", column("raw wall err (m)"), median("map_wall_error_median_raw_m"))};
}

Figures speedRows() {
  return {row("realtime_factor", column("x real time", 1),
              median("realtime_factor_median", always(column("x real time", 1))))};
}

/// How the vehicle was flown.
Figures conductRows() {
  return {
      row("tilted_share", percent("over 10 deg"),
          atMost("tilted_share_max", "share of the time tilted",
                 "Greatest share of the time in the air with a tilt of more than 10 deg.", kIfMeasured),
          greatest("tilted_share_max", percent("tilted, of its time"))),
      row("tilt_max_deg", column("tilt max (deg)", 1)),
      row("thrust_margin_min", column("thrust margin", 2),
          atLeast("thrust_margin_min", "thrust margin",
                  "Least thrust at 95 % throttle over the weight, at the least charge in the air.", kIfMeasured,
                  Bounds{0, 10}),
          least("thrust_margin_min", column("thrust margin min", 2))),
      row("touch_down_speed_m_s", column("touch-down (m/s)", 2),
          atMost("touch_down_speed_max_m_s", "touch-down speed, m/s", "Greatest speed of descent at a touch-down.",
                 kIfMeasured),
          greatest("touch_down_speed_max_m_s", column("touch-down max (m/s)", 2))),
      // Asked however the flight ended: without the figure its fault never began, and the trial tested nothing.
      row("safe_action_s", column("fault to safe (s)", 2),
          atMost("safe_action_max_s", "time from fault to safe action, s",
                 "Greatest time from the beginning of a fault until the vehicle holds, lands or stands.", kAlways),
          greatest("safe_action_max_s", column("fault to safe max (s)", 2))),
  };
}

Figures laserLatencyRows() {
  return {row("laser_latency_median_s", milliseconds("laser latency (ms)")),
          row("laser_latency_p95_s", milliseconds("95 % (ms)"))};
}

Figures behaviorRows() {
  return {
      row("keep_out_gap_m",
          atLeast("keep_out_gap_min_m", "distance from keep-out zones, m",
                  "Least distance of the hull from keep-out zones; 0: no bound.", kAlways, Bounds{0, 100}),
          least("keep_out_gap_min_m")),
      row("inspect_axis_max_deg",
          atMost("inspect_axis_max_deg", "angle to the inspected point, deg",
                 "Greatest angle between the camera's axis and the point that is inspected.", kAlways),
          greatest("inspect_axis_max_deg")),
      row("survey_coverage",
          atLeast("survey_coverage_min", "share of the surveyed floor that was seen",
                  "Least share of the open floor of a surveyed area that the camera has seen.", kAlways),
          least("survey_coverage_min")),
      row("explored_unseen_share",
          atMost("explored_unseen_max", "share of the reachable area unseen when exploring was done",
                 "Greatest share of the area that the hull could reach, by the truth, which was not in the map when "
                 "`Explore` ended as a success; 1: no bound.",
                 kOfMeasured, Bounds{0, 1}),
          greatest("explored_unseen_share_max")),
      row("explored_unseen_volume_share", greatest("explored_unseen_volume_share_max")),
      row("follow_share",
          atLeast("follow_share_min", "share of the time at the distance of following",
                  "Least share of the time of following, in each flight mode, with the person 1.5 to 3 m away.",
                  kAlways),
          least("follow_share_min")),
      row("follow_first_share", least("follow_first_share_min")),
      row("follow_last_share", least("follow_last_share_min")),
      row("follow_nearest_m"),
      row("follow_farthest_m"),
      row("follow_lost_s",
          atMost("follow_lost_max_s", "time in which the person was lost, s",
                 "Greatest time in which the person who is followed was not within 1 m of the believed place.",
                 kAlways),
          greatest("follow_lost_max_s")),
      row("targets_found",
          atLeast("targets_found_min", "share of the targets that were found",
                  "Least share of the trial's targets that are found.", kAlways),
          least("targets_found_min")),
      row("target_error_max_m",
          atMost("target_error_max_m", "error of a target's place, m",
                 "Greatest distance of a found target from the middle of the true one.", kAlways),
          greatest("target_error_max_m")),
      row("target_error_median_m", median("target_error_median_m")),
      row("false_targets",
          atMost("false_targets_max", "targets that are none",
                 "Greatest number of found targets that are none of the trial's, or are one of them again.", kAlways,
                 common::config::atLeast(0.0)),
          greatest("false_targets_max")),
      row("landing_error_m",
          atMost("landing_error_max_m", "distance from the target that it landed on, m",
                 "Greatest horizontal distance of where the vehicle stands at the end from the middle of the first "
                 "target, on which it is to land; a flight that stands more than 0.5 m off has not landed on it.",
                 kAlways),
          greatest("landing_error_max_m"), median("landing_error_median_m")),
  };
}

/// Shares of the full battery: what the vehicle predicts for the flight home when that begins, what it took by the
/// truth, and |predicted - needed| / needed.
Figures homeEnergyRows() {
  return {
      row("home_energy_predicted", percent("home energy told")),
      row("home_energy_needed", percent("needed")),
      row("home_energy_error",
          atMost(
              "home_energy_error_max", "error of the energy for the flight home",
              "Greatest relative error of the charge that the vehicle predicts for the flight home when that begins.",
              kIfMeasured),
          greatest("home_energy_error_max", percent("home energy err max"))),
  };
}

Figures machineRows() {
  using common::MachineUse;
  return {
      row("memory_peak_MB", key("memory_peak_MB"),
          atMost("memory_max_MB", "memory, MB",
                 "Greatest resident memory of the program, in 10^6 bytes. Flights side by side (--jobs) share it.",
                 kAlways),
          greatest("memory_peak_MB", column("memory max (MB)", 0)), follows(ofMachine<&MachineUse::memory_peak_MB>)),
      row("frame_first_ms", key("frame_first_ms"), follows(ofMachine<&MachineUse::frame_first_ms>)),
      row("frame_last_ms", key("frame_last_ms"), follows(ofMachine<&MachineUse::frame_last_ms>)),
      row("frame_growth", kNot,
          atMost("frame_growth_max", "camera frame at the end over one at the start",
                 "Greatest processor time of a camera frame in the 3D map, median of the last tenth of the frames "
                 "over that of the first tenth.",
                 kAlways),
          greatest("frame_growth_max", column("frame at the end / start", 2)),
          follows([](const FlightScore& flight) { return flight.machine.frameGrowth(); })),
      row("plan_median_ms", key("plan_median_ms"), median("plan_time_median_ms"),
          follows(ofMachine<&MachineUse::plan_median_ms>)),
      row("plan_max_ms", key("plan_max_ms"), greatest("plan_time_max_ms"),
          follows(ofMachine<&MachineUse::plan_max_ms>)),
  };
}

/// In the order of the figures over all flights in results.json.
Figures allFigures() {
  using enum FigureGroup;
  std::pair<FigureGroup, Figures> groups[] = {
      {kVerdict, verdictRows()},
      {kCoverage, coverageRows()},
      {kGoals, goalRows()},
      {kMission, missionRows()},
      {kDistance, distanceRows()},
      {kFlightTime, flightTimeRows()},
      {kCourse, courseRows()},
      {kSpace, spaceRows()},
      {kEstimate, estimateRows()},
      {kMap3d, map3dRows()},
      {kCamera, cameraRows()},
      {kVisualOdometry, visualOdometryRows()},
      {kLocalization, localizationRows()},
      {kClearance, {row("min_clearance_m", column("clearance (m)", 2))}},
      {kWalkers, {row("min_walker_clearance_m")}},
      {kConduct, conductRows()},
      {kLatency, laserLatencyRows()},
      {kBehaviors, behaviorRows()},
      {kHomeEnergy, homeEnergyRows()},
      {kRawFrame, rawFrameRows()},
      {kSpeed, speedRows()},
      {kMachine, machineRows()},
  };
  Figures all;
  for (auto& [group, figures] : groups)
    for (FlightFigure& figure : figures) {
      figure.group = group;
      for (TrialFigure& over_flights : figure.over_flights) over_flights.figure = figure.name;
      all.push_back(std::move(figure));
    }
  return all;
}

}  // namespace

const std::vector<FlightFigure>& flightFigures() {
  static const Figures all = allFigures();
  return all;
}

}  // namespace swiftlet::evaluation
