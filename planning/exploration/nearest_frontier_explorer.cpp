// Flies to the nearest frontier and looks from there (Yamauchi 1997).
#include <algorithm>
#include <cmath>

#include "planning/exploration/frontier_survey.hpp"

namespace swiftlet::planning {
namespace {

/// 1 at the vehicle, and less the longer the path is.
double nearness(double path_m) { return 1.0 / (1.0 + path_m); }

/// Lookouts are ordered by rings around the frontier; the first one is in the nearest ring.
const Lookout& nearestToIt(const SeenFrontier& seen) { return seen.lookouts.front(); }

}  // namespace

ExplorationResult exploreNearestFrontier(const ExplorationInput& input, const ExplorerConfig& config) {
  FrontierSurvey survey(input);
  if (survey.shutIn()) return survey.finish(std::nullopt, false);
  const CostMap& map = survey.map();
  const Scout scout(map, survey.field(), config, input.bounds ? &*input.bounds : nullptr);
  const std::vector<SeenFrontier> seen = survey.seenBy(scout);
  if (seen.empty()) return survey.finish(std::nullopt, false);

  std::vector<std::size_t> numbers;
  for (const SeenFrontier& frontier : seen) {
    numbers.push_back(frontier.number);
    survey.score(frontier.number, nearness(nearestToIt(frontier).path_m));
  }
  const auto nearest = std::min_element(seen.begin(), seen.end(), [](const auto& a, const auto& b) {
    return nearestToIt(a).path_m < nearestToIt(b).path_m;
  });
  const bool keep = survey.ofCurrent(numbers).has_value();
  const Lookout lookout = keep ? survey.currentLookout() : nearestToIt(*nearest);
  const Eigen::Vector2d place_m = map.centerOf(lookout.place), target_m = map.centerOf(lookout.target);
  const double yaw_rad =
      keep ? input.current->pose_map.yaw_rad : std::atan2(target_m.y() - place_m.y(), target_m.x() - place_m.x());
  return survey.finish(Viewpoint{{place_m.x(), place_m.y(), yaw_rad},
                                 target_m,
                                 scout.view(lookout.place, yaw_rad).gain_m2,
                                 nearness(lookout.path_m)},
                       keep);
}

}  // namespace swiftlet::planning
