#include "common/validation.hpp"
#include "perception/scan_matching/correlative_matcher.hpp"
#include "perception/scan_matching/likelihood_field.hpp"

namespace swiftlet::perception {

void CorrelativeMatcherConfig::describe(common::config::Fields& fields) {
  fields("resolution_m", resolution_m, "Of the finest level.");
  fields("angular_resolution_deg", angular_resolution_deg, "Of the finest level.");
  fields("levels", levels, "Resolutions in the weighted mean, each twice as coarse as the one before.");
  fields.choice("estimate", estimate, {"finest", "weighted_mean", "surface", "score_grid"},
                "How the pose is taken from the scores.");
  fields("sigma_m", sigma_m, "Spread of the end points about the contour of the reference.");
  fields("search_points", search_points, "Points of a scan that are searched with.");
  fields("surface_points", surface_points, "Points from which pose and covariance are taken around the best.");
  fields("only_seen", only_seen, "Points that the reference has not seen, and those beside them, do not pull.");
  fields("max_range_m", max_range_m, "Points farther than this are not used.");
  fields("max_gap_m", max_gap_m, "Neighbouring end points nearer than this are joined to a contour.");
  fields("guess_weight", guess_weight, "A pose far from the guess loses at most this much quality.");
  fields("guess_distance_m", guess_distance_m, "Half of it is lost at this distance.");
  fields("guess_rotation_deg", guess_rotation_deg, "Or at this rotation.");
  fields("min_quality", min_quality, "Below this mean score the match failed.");
  fields("min_points", min_points, "With fewer points the match failed.");
  fields("covariance_scale", covariance_scale, "Factor on the covariance of independent points.");
  fields("attitude_error_deg", attitude_error_deg, "Error of roll and pitch, which the covariance allows for.");
  fields("profile_half_m", profile_half_m, "How far along the least held direction the score is looked at.");
  fields("profile_temperature", profile_temperature, "Difference in quality that makes a pose e times less likely.");
  fields("min_normal_spread", min_normal_spread,
         "A direction with a smaller share of the contour facing it is not seen.");
  fields("unobservable_sigma_m", unobservable_sigma_m, "A direction less certain than this is not seen.");
}

std::vector<std::string> CorrelativeMatcherConfig::validate() const {
  return common::Validation()
      .within("resolution_m", resolution_m, 0.001, 1)
      .within("angular_resolution_deg", angular_resolution_deg, 0.01, 10)
      .within("levels", levels, 1, 3)
      .within("sigma_m", sigma_m, 0.5 * resolution_m, LikelihoodField::kMaxKernelCells * resolution_m / 3.0 + 1e-9)
      .within("search_points", search_points, 10, 256)
      .within("surface_points", surface_points, 10, 4096)
      .within("max_range_m", max_range_m, 0.5, 100)
      .within("max_gap_m", max_gap_m, 0, 10)
      .within("guess_weight", guess_weight, 0, 1)
      .within("guess_distance_m", guess_distance_m, 0.001, 100)
      .within("guess_rotation_deg", guess_rotation_deg, 0.01, 360)
      .within("min_quality", min_quality, 0, 1)
      .within("min_points", min_points, 3, 256)
      .within("covariance_scale", covariance_scale, 0.01, 1000)
      .within("attitude_error_deg", attitude_error_deg, 0, 20)
      .within("profile_half_m", profile_half_m, 0, 5)
      .within("profile_temperature", profile_temperature, 0.0001, 1)
      .within("min_normal_spread", min_normal_spread, 0, 0.5)
      .within("unobservable_sigma_m", unobservable_sigma_m, 0.001, 0.9)
      .problems();
}

}  // namespace swiftlet::perception
