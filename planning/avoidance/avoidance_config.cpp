#include "planning/avoidance/avoidance_config.hpp"

#include <fmt/format.h>

#include "common/config_fields.hpp"

namespace swiftlet::planning {

void AvoidanceConfig::describe(common::config::Fields& fields) {
  fields("bins", bins, {4, 1000}, "Sectors into which the field of view is divided.");
  fields("field_of_view_deg", field_of_view_deg, {10, 360},
         "Angle centred on the nose in which the layer relies on the laser.");
  fields.choice("bin_range", bin_range, {"mean", "robust_minimum"}, "Range that represents the beams of a bin.");
  fields("smoothing_window", smoothing_window, {1, 101}, "Beams of the sliding mean that `mean` smooths with.");
  fields("max_speed_m_s", max_speed_m_s, {0.05, 20}, "Speed limit where nothing is near.");
  fields("deceleration_m_s2", deceleration_m_s2, {0.1, 20}, "Deceleration that braking is planned with.");
  fields("blind_speed_m_s", blind_speed_m_s, {0.05, 20}, "Speed limit on a course that the laser does not see.");
  fields("latency_s", latency_s, {0, 2},
         "Time from a processed scan to its first effect on the speed; the age of the scan is added.");
  fields("lag_s", lag_s, {0, 2},
         "Lag of the vehicle's speed behind its limit: attitude and motors follow their commands in about this time.");
  fields("margin_m", margin_m, {0, 2}, "Distance between hull and obstacle when the vehicle has stopped.");
  fields("retreat_distance_m", retreat_distance_m, {0, 5},
         "Something unmapped nearer to the hull than this makes the vehicle retreat.");
  fields("contact_time_s", contact_time_s, {0, 10},
         "Something moving that would arrive within this time makes the vehicle retreat.");
  fields("contact_gap_m", contact_gap_m, {0, 5}, "Passing nearer than this to the hull counts as arriving.");
  fields("closing_speed_m_s", closing_speed_m_s, {0.01, 5},
         "An obstacle that approaches more slowly than this does not count as moving.");
  fields("mapped_within_m", mapped_within_m, {0, 1},
         "A return this near to something mapped or unknown is not unmapped.");
  fields.choice("retreat_rule", retreat_rule, {"clear_course", "opposite", "potential_field"},
                "How the course of a retreat is chosen.");
  fields("field_range_m", field_range_m, {0.05, 10},
         "Distance from the hull within which a return repels, for the rule potential_field.");
  fields("retreat_speed_m_s", retreat_speed_m_s, {0.05, 10}, "Greatest speed of a retreat.");
  fields("retreat_margin_m", retreat_margin_m, {0, 2}, "Distance between hull and obstacle when a retreat has ended.");
  fields("view_margin_deg", view_margin_deg, {0, 180},
         "While retreating the vehicle turns until the danger and its course are this far within the field of view.");
  fields("release_factor", release_factor, {1, 5},
         "Factor on distances and times while retreating, so that a retreat does not flicker.");
  fields("calm_s", calm_s, {0, 10}, "A retreat ends this long after the danger.");
  fields("self_radius_m", self_radius_m, {0, 1}, "Returns nearer to the origin than this are the vehicle itself.");
}

std::vector<std::string> AvoidanceConfig::validateAgainst(double clearance_m, double keep_out_m) const {
  std::vector<std::string> problems;
  if (margin_m >= clearance_m)
    problems.push_back(
        fmt::format("margin_m: {:.2f} m forbids the clearance of {:.2f} m that the planner may use; it must be smaller",
                    margin_m, clearance_m));
  if (retreat_distance_m * release_factor > clearance_m + keep_out_m)
    problems.push_back(
        fmt::format("retreat_distance_m: {:.2f} m (times {:.2f} to be released) forbids passing unmapped things at "
                    "{:.2f} m, as the "
                    "planner may; it must be smaller",
                    retreat_distance_m, release_factor, clearance_m + keep_out_m));
  return problems;
}

}  // namespace swiftlet::planning
