#include "evaluation/target_score.hpp"

#include <algorithm>

#include "common/config_fields.hpp"
#include "common/quantile.hpp"
#include "common/validation.hpp"
#include "evaluation/figure_measures.hpp"

namespace swiftlet::evaluation {
namespace {

struct Pair {
  double apart_m = 0.0;
  std::size_t truth = 0, reported = 0;
};

}  // namespace

void TrialTarget::describe(common::config::Fields& fields) {
  fields("model", model, "Name of the model in the world; its place is the middle of the box around it.");
  fields("name", name, "Name of the targets of its kind, as the profile has it.");
}

std::vector<common::Problem> TrialTarget::validate() const {
  return common::Validation().given(!model.empty(), "model").given(!name.empty(), "name").problems();
}

void measureTargets(const std::vector<common::Target>& reported, const std::vector<TrueTarget>& truth,
                    const common::Pose3& T_world_map, FlightScore& score) {
  if (truth.empty()) return;
  double all_found = 0.0;
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < reported.size(); ++i) {
    if (reported[i].state != common::TargetState::kFound) continue;
    all_found += 1.0;
    for (std::size_t j = 0; j < truth.size(); ++j) {
      const double apart_m = (T_world_map * reported[i].position_map_m - truth[j].middle_world_m).norm();
      if (reported[i].name == truth[j].name && apart_m <= kTargetMatch_m) pairs.push_back({apart_m, j, i});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.apart_m < b.apart_m; });
  std::vector<bool> found(truth.size(), false), used(reported.size(), false);
  std::vector<double> errors_m;
  for (const Pair& pair : pairs) {
    if (found[pair.truth] || used[pair.reported]) continue;
    found[pair.truth] = used[pair.reported] = true;
    errors_m.push_back(pair.apart_m);
  }
  const auto matched = static_cast<double>(errors_m.size());
  score["targets_found"] = matched / static_cast<double>(truth.size());
  score["false_targets"] = all_found - matched;
  if (errors_m.empty()) return;
  score["target_error_max_m"] = common::quantile(errors_m, 1.0);
  score["target_error_median_m"] = common::quantile(errors_m, 0.5);
}

}  // namespace swiftlet::evaluation
