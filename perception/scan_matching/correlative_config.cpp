#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "common/validation.hpp"
#include "perception/scan_matching/correlative_matcher.hpp"
#include "perception/scan_matching/likelihood_field.hpp"

namespace swiftlet::perception {

void CorrelativeMatcherConfig::describe(common::config::Fields& fields) {
  fields("resolution_m", resolution_m, {0.001, 1},
         "Side of a cell of the finest level; each coarser level doubles it.");
  fields("angular_resolution_deg", angular_resolution_deg, {0.01, 10}, "Step of the rotation at the finest level.");
  fields(
      "levels", levels, {1, 3},
      "Resolutions in the weighted mean, each twice as coarse as the one before (1, 2 and 4 cm: Grzonka 2012, IV-A).");
  fields.choice("estimate", estimate, {"finest", "weighted_mean", "surface", "score_grid"},
                "How the pose is taken from the scores.");
  fields("sigma_m", sigma_m, {0.0005, 5},
         "Spread of the end points about the contour of the reference, from half a resolution_m up to what the field's "
         "kernel holds.");
  fields("search_points", search_points, {10, 256},
         "Points of a scan that are searched with, spread evenly along its contour.");
  fields("surface_points", surface_points, {10, 4096},
         "Points from which pose and covariance are taken around the best.");
  fields("only_seen", only_seen,
         "Whether points beyond what the reference saw, and at its ends, are left out of pose and covariance, since "
         "what comes out of a shadow would pull the scan along.");
  fields("max_range_m", max_range_m, {0.5, 100},
         "Points farther than this are not used, which bounds the memory of the field.");
  fields(
      "max_gap_m", max_gap_m, {0, 10},
      "Neighbouring end points of the reference nearer than this are joined to a contour; more than 0.3 m apart only "
      "along a straight line.");
  fields("guess_weight", guess_weight, {0, 1},
         "Greatest loss of quality of a pose far from the guess, as the motion's prior.");
  fields("guess_distance_m", guess_distance_m, {0.001, 100},
         "Distance from the guess at which half of guess_weight is lost.");
  fields("guess_rotation_deg", guess_rotation_deg, {0.01, 360},
         "Rotation from the guess at which half of guess_weight is lost.");
  fields("min_quality", min_quality, {0, 1}, "Below this mean score the match failed.");
  fields("min_points", min_points, {3, 256}, "With fewer points the match failed.");
  fields("covariance_scale", covariance_scale, {0.01, 1000},
         "Factor on the covariance of independent points, calibrated by the tests of the covariance.");
  fields("attitude_error_deg", attitude_error_deg, {0, 20},
         "Error of roll and pitch, which moves each end point by its height over the body times this.");
  fields("unobservable_sigma_m", unobservable_sigma_m, {0.001, 0.9},
         "A direction less certain than this is not observed: the pose keeps the guess there.");
  fields("profile_half_m", profile_half_m, {0, 5},
         "Distance along the least certain direction within which poses that score nearly as well widen the "
         "covariance; 0 for none.");
  fields("profile_temperature", profile_temperature, {0.0001, 1},
         "Difference in quality that makes a pose e times less likely.");
  fields("min_normal_spread", min_normal_spread, {0, 0.5},
         "A direction that a smaller share of the contour faces is not observed, as a corridor's axis.");
}

std::vector<std::string> CorrelativeMatcherConfig::validate() const {
  const double kernel_m = LikelihoodField::kMaxKernelCells * resolution_m;
  return common::Validation()
      .require(
          sigma_m >= 0.5 * resolution_m && sigma_m <= kernel_m / 3.0 + 1e-9, "sigma_m",
          fmt::format("{} is not within {} and {} at this resolution_m", sigma_m, 0.5 * resolution_m, kernel_m / 3.0))
      .problems();
}

}  // namespace swiftlet::perception
