#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "common/validation.hpp"
#include "perception/scan_matching/correlative_matcher.hpp"
#include "perception/scan_matching/likelihood_field.hpp"

namespace swiftlet::perception {

void CorrelativeMatcherConfig::describe(common::config::Fields& fields) {
  fields("resolution_m", resolution_m, {0.001, 1},
         "Side of a cell of the finest level; each coarser level doubles it.");
  fields(
      "levels", levels, {1, 3},
      "Resolutions in the weighted mean, each twice as coarse as the one before (1, 2 and 4 cm: Grzonka 2012, IV-A).");
  fields.choice("estimate", estimate, {"finest", "weighted_mean", "surface", "score_grid"},
                "How the pose is taken from the scores.");
  fields("only_seen", only_seen,
         "Whether points beyond what the reference saw, and at its ends, are left out of pose and covariance, since "
         "what comes out of a shadow would pull the scan along.");
  fields("guess_weight", guess_weight, {0, 1},
         "Greatest loss of quality of a pose far from the guess, as the motion's prior.");
  fields("profile_half_m", profile_half_m, {0, 5},
         "Distance along the least certain direction within which poses that score nearly as well widen the "
         "covariance; 0 for none.");
}

std::vector<common::Problem> CorrelativeMatcherConfig::validate() const {
  const double kernel_m = LikelihoodField::kMaxKernelCells * resolution_m;
  return common::Validation()
      .require(sigma_m >= 0.5 * resolution_m && sigma_m <= kernel_m / 3.0 + 1e-9, "sigma_m",
               common::Message("matcher.sigma", "{} is not within {} and {} at this resolution_m", sigma_m,
                               0.5 * resolution_m, kernel_m / 3.0))
      .problems();
}

}  // namespace swiftlet::perception
