// The table of the figures of a flight: one row each.
#include <utility>

#include "evaluation/figure_rows.hpp"

namespace swiftlet::evaluation {
namespace {

template <Verdict kVerdict>
Value is(const FlightScore& flight) {
  return flight.verdict == kVerdict ? 1.0 : 0.0;
}

Figures verdicts() {
  return {
      {.name = "done",
       .over_flights = {judged(mean("done_share", percent("done")),
                               {"done_share_min", "share of flights done",
                                "Least share of all flights that did their mission.", kAtLeast, kIfMeasured, kShare})},
       .of = is<Verdict::kDone>},
      {.name = "needless",
       .over_flights = {judged(mean("needless_share", percent("needless")),
                               {"needless_share_max", "share of flights that landed or refused needlessly",
                                "With verdicts, greatest share of all flights that landed or refused without a reason "
                                "that the truth confirms.",
                                kAtMost, kIfMeasured, kShare})},
       .of = is<Verdict::kNeedless>},
  };
}

/// Share of the free space that the hull can cover, at the mission's clearance.
Figures coverage() {
  return {{.name = "coverage",
           .column = percent("coverage"),
           .criterion = {"coverage_min", "coverage", "Least share of the reachable free space that is in the map.",
                         kAtLeast, kOfMission, kShare},
           .over_flights = {always(least("coverage_min", percent("coverage min")))}}};
}

/// The worst error of the goals that were reached, of home, and of the estimate there: marker_errors.hpp.
Figures goals() {
  return {
      {.name = "goal_error_m",
       .column = {"goal err (m)"},
       .criterion = {"goal_error_max_m", "goal error, m",
                     "Greatest distance of the vehicle from a goal that is reported as reached."},
       .over_flights = {always(greatest("goal_error_max_m", {"goal err max (m)"})),
                        judged(always(median("goal_error_median_m", {"median (m)"})),
                               {"goal_error_median_max_m", "goal error median, m",
                                "Greatest median of all flights' goal errors."})}},
      {.name = "home_error_m",
       .column = {"home err (m)"},
       .criterion = {"home_error_max_m", "home error, m",
                     "Greatest distance of the vehicle from home when that is reported as reached."},
       .over_flights = {always(greatest("home_error_max_m", {"home err max (m)"})),
                        judged(always(median("home_error_median_m", {"median (m)"})),
                               {"home_error_median_max_m", "home error median, m",
                                "Greatest median of all flights' home errors."})}},
      {.name = "marker_error_m",
       .criterion = {"marker_error_max_m", "marker error, m",
                     "Greatest error of the estimate when a goal or home is reported as reached."},
       .over_flights = {greatest("marker_error_max_m", {"marker err max (m)"}), median("marker_error_median_m")}},
      {.name = "relocalization_error_m",
       .criterion = {"relocalization_error_max_m", "relocalization error, m",
                     "Greatest difference between the estimate's errors at the same goal at different times."},
       .over_flights = {greatest("relocalization_error_max_m", {"relocalization max (m)"}),
                        median("relocalization_error_median_m")}},
      {.name = "open_loop_error_m"},
  };
}

/// A mission that never began has no time.
Figures missionTimes() {
  return {
      {.name = "mission_time_s",
       .in_results = kOrZero,
       .column = {"time (s)", 1},
       .criterion = {"mission_time_max_s", "mission time, s", "Greatest simulated time of the mission."}},
      {.name = "done_mission_time_s",
       .in_results = kNot,
       .over_flights = {judged(
           always(median("mission_time_median_s", {"time median (s)", 1})),
           {"mission_time_median_max_s", "mission time median, s",
            "Greatest median of the times of all missions that ended well.", kAtMost, kIfMeasured})},
       .of = [](const FlightScore& flight) -> Value {
         return flight.mission_done ? flight.figure("mission_time_s") : std::nullopt;
       }},
  };
}

/// True and horizontal.
Figures distance() {
  return {{.name = "distance_m",
           .column = {"distance (m)", 1},
           .criterion = {"unfinished_distance_min_m", "distance flown without having done the mission, m",
                         "Least distance flown by a vehicle that ends without having done its mission.", kAtLeast,
                         kOfUndone, Bounds{0, 1e5}},
           .over_flights = {median("distance_median_m")}}};
}

Figures flightTime() { return {{.name = "flight_time_s", .over_flights = {median("flight_time_median_s")}}}; }

Figures course() {
  return {
      {.name = "end_distance_m",
       .criterion = {"end_distance_max_m", "distance from the take-off place at the end, m",
                     "Greatest horizontal distance from the take-off place at which the vehicle is at the end.",
                     kAtMost, kAlways}},
      {.name = "speed_max_m_s"},
      {.name = "explored_area_m2"},
  };
}

/// The area that the hull can cover, of which the coverage is a share.
Figures space() { return {{.name = "reachable_area_m2", .in_results = kOrZero}}; }

/// Against the truth in the frame that the vehicle can know, without alignment.
Figures estimate() {
  return {
      {.name = "estimate_rms_m",
       .column = {"estimate RMS (m)"},
       .criterion = {"estimate_rms_max_m", "estimate RMS, m", "Greatest RMS of the estimate's horizontal error."},
       .over_flights = {judged(
           always(median("estimate_rms_median_m", {"RMS median (m)"})),
           {"estimate_rms_median_max_m", "estimate RMS median, m", "Greatest median of all flights' RMS errors."})}},
      {.name = "estimate_spatial_rms_m",
       .criterion = {"estimate_spatial_rms_max_m", "estimate RMS in space, m",
                     "Greatest RMS of the estimate's error in space, the height's included."}},
      {.name = "estimate_yaw_rms_rad"},
      {.name = "map_wall_error_median_m",
       .column = {"wall err (m)"},
       .criterion = {"map_wall_error_max_m", "map wall error, m",
                     "Greatest median distance of mapped walls to true ones."},
       .over_flights = {judged(always(median("map_wall_error_median_m", {"wall err median (m)"})),
                               {"map_wall_error_median_max_m", "map wall error median, m",
                                "Greatest median of all flights' wall errors."})}},
      {.name = "map_wall_error_p95_m"},
  };
}

/// Distance of the cloud to the nearest surface, cloud_metrics.hpp: the map where the vehicle can know it to be, and
/// after one rigid motion of the whole cloud.
Figures map3d() {
  return {
      {.name = "map3d_points", .key = "points", .in_results = kCount},
      {.name = "map3d_error_median_m",
       .key = "error_median_m",
       .criterion = {"map3d_error_max_m", "3D map error, m",
                     "Greatest median distance of the 3D map's cubes of 10 cm to true surfaces, the map as it stands."},
       .over_flights = {median("map3d_error_median_m"), greatest("map3d_error_max_m", {"3D map err max (m)"})}},
      {.name = "map3d_error_p95_m", .key = "error_p95_m"},
      {.name = "map3d_aligned_median_m",
       .key = "aligned_median_m",
       .criterion = {"map3d_aligned_error_max_m", "3D map error aligned, m",
                     "Greatest median distance of the 3D map's cubes of 10 cm to true surfaces, after one rigid motion "
                     "of all of them."},
       .over_flights = {greatest("map3d_aligned_error_max_m", {"aligned (m)"})}},
      {.name = "map3d_aligned_p95_m",
       .key = "aligned_p95_m",
       .criterion =
           {"map3d_aligned_p95_max_m", "3D map error aligned of 95 %, m",
            "Greatest distance within which 95 % of the 3D map's cubes of 10 cm are, after one rigid motion of "
            "all of them."},
       .over_flights = {greatest("map3d_aligned_p95_max_m", {"aligned 95 % (m)"})}},
      {.name = "map3d_coverage",
       .key = "coverage",
       .criterion = {"map3d_coverage_min", "3D map coverage",
                     "Least share of the surfaces in view of the RGB-D camera that have points of the 3D map within 10 "
                     "cm.",
                     kAtLeast, kOfMission, kShare},
       .over_flights = {least("map3d_coverage_min", percent("3D coverage min"))}},
  };
}

/// What the flight knew at its end of the camera's mount, and what its data sheet says of it, as angles to the true
/// one; and of the camera's clock.
Figures camera() {
  return {{.name = "camera_mount_error_rad", .key = "mount_rad"},
          {.name = "camera_mount_error_of_data_sheet_rad", .key = "sheet_rad"},
          {.name = "camera_clock_error_s", .key = "clock_s"}};
}

Figures visualOdometry() {
  return {{.name = "visual_odometry_rms_m", .key = "rms_m", .over_flights = {median("visual_odometry_rms_median_m")}},
          {.name = "visual_odometry_lost_share",
           .key = "lost_share",
           .over_flights = {greatest("visual_odometry_lost_share_max")}}};
}

/// In the map that the flight was given. Localized in time: the first pose was right, and came within
/// Criteria::localized_within_m.
Figures localization() {
  return {
      {.name = "localized_in_time",
       .key = "in_time",
       .in_results = kFlag,
       .over_flights = {judged(
           mean("localized_flights", percent("localized")),
           {"localized_flights_min", "flights localized", "Least share of all flights that were localized.", kAtLeast,
            kIfMeasured, kShare, "no flight was given a map"})}},
      {.name = "localization_path_length_m",
       .key = "path_length_m",
       .over_flights = {median("localization_path_length_median_m", {"after, median (m)", 1}),
                        greatest("localization_path_length_max_m")}},
      {.name = "localization_error_m", .key = "error_m"},
      {.name = "localization_error_rad", .key = "error_rad"},
      {.name = "localized_time_share", .key = "time_share"},
      {.name = "wrong_time_share",
       .key = "wrong_share",
       .criterion = {"wrong_time_share_max", "share of the time localized wrongly",
                     "Greatest share of the time localized in which the estimate is farther than 0.5 m or 10 deg from "
                     "the truth."},
       .over_flights = {greatest("wrong_time_share_max", percent("wrongly, of its time"))}},
      {.name = "times_lost", .key = "times_lost", .in_results = kCount},
  };
}

/// In the frame of the take-off with the true heading of the body: the mount's yaw counts as an error. The summary
/// shows them below the figures of the same name without `raw`.
Figures rawFrame() {
  return {
      {.name = "goal_error_raw_m",
       .column = {"raw goal err (m)"},
       .over_flights = {greatest("goal_error_max_raw_m"), median("goal_error_median_raw_m")}},
      {.name = "home_error_raw_m",
       .column = {"raw home err (m)"},
       .over_flights = {greatest("home_error_max_raw_m"), median("home_error_median_raw_m")}},
      {.name = "estimate_rms_raw_m", .column = {"raw RMS (m)"}, .over_flights = {median("estimate_rms_median_raw_m")}},
      {.name = "map_wall_error_median_raw_m",
       .column = {"raw wall err (m)"},
       .over_flights = {median("map_wall_error_median_raw_m")}}};
}

Figures speed() {
  return {{.name = "realtime_factor",
           .column = {"x real time", 1},
           .over_flights = {always(median("realtime_factor_median", {"x real time", 1}))}}};
}

/// In the order of the figures over all flights in results.json.
Figures allFigures() {
  using enum FigureGroup;
  std::pair<FigureGroup, Figures> groups[] = {
      {kVerdict, verdicts()},
      {kCoverage, coverage()},
      {kGoals, goals()},
      {kMission, missionTimes()},
      {kDistance, distance()},
      {kFlightTime, flightTime()},
      {kCourse, course()},
      {kSpace, space()},
      {kEstimate, estimate()},
      {kMap3d, map3d()},
      {kCamera, camera()},
      {kVisualOdometry, visualOdometry()},
      {kLocalization, localization()},
      {kClearance, {{.name = "min_clearance_m", .column = {"clearance (m)", 2}}}},
      {kWalkers, {{.name = "min_walker_clearance_m"}}},
      {kConduct, conductFigures()},
      {kLatency, latencyFigures()},
      {kBehaviors, behaviorFigures()},
      {kHomeEnergy, homeEnergyFigures()},
      {kRawFrame, rawFrame()},
      {kSpeed, speed()},
      {kMachine, machineFigures()},
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
