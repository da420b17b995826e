// Chooses the viewpoint that shows most for its travel time.
#include <algorithm>

#include "planning/exploration/frontier_survey.hpp"
#include "planning/exploration/viewpoint_options.hpp"

namespace swiftlet::planning {
namespace {

/// Frontiers, from the nearest on, for which viewpoints are evaluated in one call.
constexpr std::size_t kMaxEvaluated = 30;
/// The present viewpoint is left only for one that is better by this share.
constexpr double kHysteresis = 0.25;

/// One call of exploreByUtility().
class Choice {
 public:
  Choice(const ExplorationInput& input, const ExplorerConfig& config)
      : survey_(input),
        scout_(survey_.map(), survey_.field(), config, input.bounds ? &*input.bounds : nullptr),
        viewpoints_(input, config, survey_, scout_) {}

  ExplorationResult run() {
    if (survey_.shutIn()) return survey_.finish(std::nullopt, false);
    evaluate();
    std::vector<std::size_t> frontiers;
    for (const ViewpointOption& option : options_) frontiers.push_back(option.frontier);
    const auto current = viewpoints_.current(frontiers);
    if (options_.empty()) return survey_.finish(std::nullopt, false);
    const ViewpointOption& best = greatestUtility();
    const bool keep = current && best.utility <= current->utility * (1.0 + kHysteresis);
    return survey_.finish(viewpoints_.viewpointOf(keep ? *current : best), keep);
  }

 private:
  /// Finds viewpoints for the open frontiers, the nearest first, until none that is farther away can be better.
  void evaluate() {
    for (const SeenFrontier& seen : survey_.seenBy(scout_)) {
      if (options_.size() >= kMaxEvaluated) break;
      if (!options_.empty() && greatestUtility().utility >= viewpoints_.utilityBound(seen.nearest_m)) break;
      const auto best = viewpoints_.bestOf(seen);
      if (!best) continue;
      survey_.score(seen.number, best->utility);
      options_.push_back(*best);
    }
  }

  const ViewpointOption& greatestUtility() const {
    return *std::max_element(options_.begin(), options_.end(),
                             [](const auto& a, const auto& b) { return a.utility < b.utility; });
  }

  FrontierSurvey survey_;
  Scout scout_;
  ViewpointOptions viewpoints_;
  std::vector<ViewpointOption> options_;
};

}  // namespace

ExplorationResult exploreByUtility(const ExplorationInput& input, const ExplorerConfig& config) {
  return Choice(input, config).run();
}

}  // namespace swiftlet::planning
