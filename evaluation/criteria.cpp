#include "evaluation/criteria.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::evaluation {

using common::config::kPositive;

namespace {

/// What the mission reached.
void describeMission(Criteria& c, common::config::Fields& fields) {
  fields("mission_done", c.mission_done, "Whether the mission must end well.");
  fields(
      "collisions_max", c.collisions_max, {0, 1},
      "Greatest number of collisions that the vehicle could have avoided; a flight ends with the first. A person who "
      "walks into a vehicle that stands or moves away, and glass that never returned a beam, do not count.");
  fields(
      "verdicts", c.verdicts,
      "Whether a flight that did not do its mission is judged by the truth: it passes if it came home, landed inside, "
      "or refused to take off. Figures of the mission are then asked only of flights that did it.");
  fields(
      "needless_share_max", c.needless_share_max, {0, 1},
      "With verdicts, greatest share of all flights that landed or refused without a reason that the truth confirms.");
  fields("crashes_max", c.crashes_max, {0, 10'000},
         "With verdicts, greatest number of flights that crashed, where physics did not force it.");
  fields("done_share_min", c.done_share_min, {0, 1}, "Least share of all flights that did their mission.");
  fields("coverage_min", c.coverage_min, {0, 1}, "Least share of the reachable free space that is in the map.");
  fields("goal_error_max_m", c.goal_error_max_m, kPositive,
         "Greatest distance of the vehicle from a goal that is reported as reached.");
  fields("home_error_max_m", c.home_error_max_m, kPositive,
         "Greatest distance of the vehicle from home when that is reported as reached.");
  fields("marker_error_max_m", c.marker_error_max_m, kPositive,
         "Greatest error of the estimate when a goal or home is reported as reached.");
  fields("relocalization_error_max_m", c.relocalization_error_max_m, kPositive,
         "Greatest difference between the estimate's errors at the same goal at different times.");
  fields("mission_time_max_s", c.mission_time_max_s, kPositive, "Greatest simulated time of the mission.");
}

/// Criteria of the estimate.
void describeEstimate(Criteria& c, common::config::Fields& fields) {
  fields("estimate_rms_max_m", c.estimate_rms_max_m, kPositive, "Greatest RMS of the estimate's horizontal error.");
  fields("estimate_spatial_rms_max_m", c.estimate_spatial_rms_max_m, kPositive,
         "Greatest RMS of the estimate's error in space, the height's included.");
  fields("map_wall_error_max_m", c.map_wall_error_max_m, kPositive,
         "Greatest median distance of mapped walls to true ones.");
  fields("map3d_error_max_m", c.map3d_error_max_m, kPositive,
         "Greatest median distance of the 3D map's cubes of 10 cm to true surfaces, the map as it stands.");
  fields("map3d_aligned_error_max_m", c.map3d_aligned_error_max_m, kPositive,
         "Greatest median distance of the 3D map's cubes of 10 cm to true surfaces, after one rigid motion of all of "
         "them.");
  fields(
      "map3d_aligned_p95_max_m", c.map3d_aligned_p95_max_m, kPositive,
      "Greatest distance within which 95 % of the 3D map's cubes of 10 cm are, after one rigid motion of all of them.");
  fields("map3d_coverage_min", c.map3d_coverage_min, {0, 1},
         "Least share of the surfaces in view of the RGB-D camera that have points of the 3D map within 10 cm.");
  fields("localized_within_m", c.localized_within_m, kPositive,
         "Path length within which a flight that is given a map must have found itself in it to count as localized.");
  fields("wrong_time_share_max", c.wrong_time_share_max, kPositive,
         "Greatest share of the time localized in which the estimate is farther than 0.5 m or 10 deg from the truth.");
}

/// How the vehicle flew.
void describeVehicle(Criteria& c, common::config::Fields& fields) {
  fields("tilted_share_max", c.tilted_share_max, kPositive,
         "Greatest share of the time in the air with a tilt of more than 10 deg.");
  fields("thrust_margin_min", c.thrust_margin_min, {0, 10},
         "Least thrust at 95 % throttle over the weight, at the least charge in the air.");
  fields("touch_down_speed_max_m_s", c.touch_down_speed_max_m_s, kPositive,
         "Greatest speed of descent at a touch-down.");
  fields("safe_action_max_s", c.safe_action_max_s, kPositive,
         "Greatest time from the beginning of a fault until the vehicle holds, lands or stands.");
  fields("home_energy_error_max", c.home_energy_error_max, kPositive,
         "Greatest relative error of the charge that the vehicle predicts for the flight home when that begins.");
  fields("keep_out_gap_min_m", c.keep_out_gap_min_m, {0, 100},
         "Least distance of the hull from keep-out zones; 0 asks for nothing.");
}

/// What single behaviours reached.
void describeBehaviors(Criteria& c, common::config::Fields& fields) {
  fields("inspect_axis_max_deg", c.inspect_axis_max_deg, kPositive,
         "Greatest angle between the camera's axis and the point that is inspected.");
  fields("survey_coverage_min", c.survey_coverage_min, {0, 1},
         "Least share of the open floor of a surveyed area that the camera has seen.");
  fields("follow_share_min", c.follow_share_min, {0, 1},
         "Least share of the time of following, in each flight mode, with the person 1.5 to 3 m away.");
  fields("follow_lost_max_s", c.follow_lost_max_s, kPositive,
         "Greatest time in which the person who is followed was not within 1 m of the believed place.");
  fields("targets_found_min", c.targets_found_min, {0, 1}, "Least share of the trial's targets that are found.");
  fields("target_error_max_m", c.target_error_max_m, kPositive,
         "Greatest distance of a found target from the middle of the true one.");
  fields("false_targets_max", c.false_targets_max, common::config::atLeast(0.0),
         "Greatest number of found targets that are none of the trial's, or are one of them again.");
}

/// The end of a flight, and all flights together.
void describeWhole(Criteria& c, common::config::Fields& fields) {
  fields("end_distance_max_m", c.end_distance_max_m, kPositive,
         "Greatest horizontal distance from the take-off place at which the vehicle is at the end.");
  fields("unfinished_distance_min_m", c.unfinished_distance_min_m, {0, 1e5},
         "Least distance flown by a vehicle that ends without having done its mission.");
  fields("memory_max_MB", c.memory_max_MB, kPositive,
         "Greatest resident memory of the program, in 10^6 bytes. Flights side by side (--jobs) share it.");
  fields("frame_growth_max", c.frame_growth_max, kPositive,
         "Greatest processor time of a camera frame in the 3D map, median of the last tenth of the frames over that of "
         "the first tenth.");
  fields("all_resumed", c.all_resumed, "Whether everything that was interrupted must have gone on.");
  fields("goal_error_median_max_m", c.goal_error_median_max_m, kPositive,
         "Greatest median of all flights' goal errors.");
  fields("home_error_median_max_m", c.home_error_median_max_m, kPositive,
         "Greatest median of all flights' home errors.");
  fields("mission_time_median_max_s", c.mission_time_median_max_s, kPositive,
         "Greatest median of the times of all missions that ended well.");
  fields("estimate_rms_median_max_m", c.estimate_rms_median_max_m, kPositive,
         "Greatest median of all flights' RMS errors.");
  fields("map_wall_error_median_max_m", c.map_wall_error_median_max_m, kPositive,
         "Greatest median of all flights' wall errors.");
  fields("localized_flights_min", c.localized_flights_min, {0, 1}, "Least share of all flights that were localized.");
}

}  // namespace

void Criteria::describe(common::config::Fields& fields) {
  describeMission(*this, fields);
  describeEstimate(*this, fields);
  describeVehicle(*this, fields);
  describeBehaviors(*this, fields);
  describeWhole(*this, fields);
}

}  // namespace swiftlet::evaluation
