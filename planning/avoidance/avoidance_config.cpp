#include "planning/avoidance/avoidance_config.hpp"

#include "common/config_fields.hpp"
#include "common/validation.hpp"

namespace swiftlet::planning {

void AvoidanceConfig::describe(common::config::Fields& fields) {
  fields.choice("bin_range", bin_range, {"mean", "robust_minimum"}, "Range that represents the beams of a bin.");
  fields("max_speed_m_s", max_speed_m_s, {0.05, 20}, "Speed limit where nothing is near.");
  fields("deceleration_m_s2", deceleration_m_s2, {0.1, 20}, "Deceleration that braking is planned with.");
  fields("latency_s", latency_s, {0, 2},
         "Time from a processed scan to its first effect on the speed; the age of the scan is added.");
  fields("lag_s", lag_s, {0, 2},
         "Lag of the vehicle's speed behind its limit: attitude and motors follow their commands in about this time.");
  fields("margin_m", margin_m, {0, 2}, "Distance between hull and obstacle when the vehicle has stopped.");
  fields.choice("retreat_rule", retreat_rule, {"clear_course", "opposite", "potential_field"},
                "How the course of a retreat is chosen.");
}

std::vector<common::Problem> AvoidanceConfig::validateAgainst(double clearance_m, double keep_out_m) const {
  using common::Message;
  return common::Validation()
      .require(margin_m < clearance_m, "margin_m",
               Message("avoidance.margin",
                       "{:.2f} m forbids the clearance of {:.2f} m that the planner may use; it must be smaller",
                       margin_m, clearance_m))
      .require(retreat_distance_m * release_factor <= clearance_m + keep_out_m, "retreat_distance_m",
               Message("avoidance.retreat-distance",
                       "{:.2f} m (times {:.2f} to be released) forbids passing unmapped things at {:.2f} m, as the "
                       "planner may; it must be smaller",
                       retreat_distance_m, release_factor, clearance_m + keep_out_m))
      .problems();
}

}  // namespace swiftlet::planning
