#include "perception/localization/localizer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "common/check.hpp"
#include "perception/localization/candidate_places.hpp"
#include "perception/localization/greatest_sigma.hpp"
#include "perception/localization/localization_task_data.hpp"
#include "perception/localization/map_doubt.hpp"
#include "perception/localization/place_posterior.hpp"
#include "perception/localization/pose_tracker.hpp"
#include "perception/localization/scan_support.hpp"
#include "perception/localization/search_patience.hpp"
#include "perception/localization/skipped_inputs.hpp"

namespace swiftlet::perception {

using common::kRadPerDeg;
using common::Pose2;

namespace {

/// A pose is not accepted while the map explains a smaller share of the local map (docs/localization.md).
constexpr double kLeastExplained = 0.70;
/// Spread of the particles about a place that was found: the remaining error of the search.
const Eigen::Matrix3d kPlaceCovariance = common::planarCovariance(0.05, 1.0 * kRadPerDeg);

}  // namespace

struct Localizer::Impl {
  Impl(const common::OccupancyGrid& grid, const Pose2& T_map_grid_in, const LocalizerConfig& config_in,
       std::uint64_t seed)
      : config(config_in),
        T_map_grid(T_map_grid_in),
        map(std::make_shared<const MapField>(grid)),
        tracker(map, config_in, seed),
        search(std::make_shared<const GlobalSearch>(map, config_in.search)),
        local_map(config_in.local_map_length_m),
        distinction(distinctionOf(config_in)) {}

  void step(const LocalizationInput& input);
  void track(const LocalizationInput& input);
  void doubt(const LocalizationInput& input);
  void lookElsewhere(const LocalizationResult::Data& found);
  void lose(std::string reason);
  void find(const LocalizationInput& input);
  void requestSearch(const ProjectedScan& scan);
  void forgetSearches();
  void forgetAll();
  void apply(const LocalizationResult::Data& found);
  void judge(const LocalizationResult::Data& found);
  void fitsNowhere();
  void keepCandidate(const Pose2& T_grid_odom, double at_path_length_m);
  void localize(const LikelyPlace& place, const Pose2& T_odom_middle);
  void enter(LocalizationState next, std::string reason);
  LocalizationEstimate estimate();

  LocalizerConfig config;
  Pose2 T_map_grid;
  std::shared_ptr<const MapField> map;
  PoseTracker tracker;
  std::shared_ptr<const GlobalSearch> search;
  LocalMap local_map;
  LostTest lost_test;
  PlaceDistinction distinction;
  LocalizationState state = LocalizationState::kGlobal;
  bool was_localized = false;
  common::Time now;
  double elapsed_s = 0.0;
  ScanSupport support;
  int places = 0;
  double since_search_s = 0.0;  ///< Used only while localized.

  // Used only while not localized.
  struct Candidate {
    Pose2 T_grid_odom;
    double path_length_m = 0.0;  ///< Path length at which it first was the only place.
  };
  std::optional<Candidate> candidate;
  CandidatePlaces likely;
  std::optional<double> searched_path_length_m;  ///< Path length at the last search.
  SearchPatience patience;
  double nowhere_path_length_m = 0.0;  ///< Path length since which the local map fits nowhere.
  bool fits_nowhere = false;
  MapDoubt map_doubt;

  struct SearchRequest {
    std::vector<Eigen::Vector2f> scan_body_m;
    Pose2 T_odom_scan;
    double path_length_m = 0.0;
  };
  std::optional<SearchRequest> request;
  bool searching = false;   ///< The result of a search is pending.
  std::uint64_t epoch = 0;  ///< Results of a search from an earlier epoch are discarded.

  SkippedInputs skipped;
  std::optional<LocalizationEvent> event;
};

void Localizer::Impl::enter(LocalizationState next, std::string reason) {
  if (next == state) return;
  state = next;
  event = LocalizationEvent{now, next, std::move(reason)};
}

void Localizer::Impl::step(const LocalizationInput& input) {
  const bool first = !tracker.begun();
  elapsed_s = first ? 0.0 : std::max(0.0, (input.scan.stamp - now).seconds());
  now = input.scan.stamp;
  tracker.advance(input);
  if (!first && input.interrupted) forgetAll();
}

/// Discards all observations: they come from another place, or from before the odometry lost track.
void Localizer::Impl::forgetAll() {
  local_map.clear();
  forgetSearches();
  candidate.reset();
  likely.clear();
  lost_test.reset();
}

void Localizer::Impl::track(const LocalizationInput& input) {
  if (input.fresh && tracker.generationDue(input.T_odom_body)) tracker.generate(input.scan);
  if (tracker.onlyGiven()) return;
  doubt(input);
  const double uncertain_m = greatestSigma_m(tracker.covariance());
  if (state == LocalizationState::kLocalized && !(uncertain_m <= config.max_sigma_m))
    lose(fmt::format("the pose is uncertain by {:.1f} m", uncertain_m));
}

/// Checks the pose against the scan. While the check fails, scans are collected in the local map and searched for in
/// the whole map.
void Localizer::Impl::doubt(const LocalizationInput& input) {
  constexpr double kDistrustSearch_s = 0.5;  // Time between searches while the pose explains too little.
  support = supportOf(*map, input.scan.points_level_m, tracker.T_grid_body());
  const bool doubted = lost_test.doubtful();
  lost_test.add(support, elapsed_s);
  if (!lost_test.doubtful()) {
    map_doubt.believe(tracker.path_length_m(), now);
    if (!local_map.empty()) forgetSearches();
    local_map.clear();
    return;
  }
  if (!doubted) since_search_s = kDistrustSearch_s;
  const bool moved =
      local_map.empty() ||
      (between(local_map.T_odom_last(), tracker.T_odom_body()).position_m().norm() >= config.generation_distance_m);
  if (moved) local_map.add(tracker.T_odom_body(), input.scan.points_level_m);
  if (lost_test.lost())
    return lose(fmt::format("the map explains {:.0f} % of what is seen", 100.0 * lost_test.explained()));
  since_search_s += elapsed_s;
  if (since_search_s < kDistrustSearch_s) return;
  since_search_s = 0.0;
  requestSearch(input.scan);
}

void Localizer::Impl::lookElsewhere(const LocalizationResult::Data& found) {
  constexpr double kElsewhereNats = 10.0;  // Another place that is likelier by this refutes it (docs/localization.md).
  if (found.places.empty() || found.places.front().explained < kLeastExplained) return;
  const LikelyPlace& best = found.places.front();
  const Pose2 here = tracker.T_grid_odom() * found.whole.T_odom_middle;
  if (distinction.same(best.T_grid_points, here)) return;
  const double gain = best.log_likelihood - logLikelihood(*map, found.whole.points_middle_m, here, config.point_weight);
  if (gain < kElsewhereNats) return;
  const Pose2 off = between(here, best.T_grid_points);
  std::string where = fmt::format("{:.1f} m away", off.position_m().norm());
  if (off.position_m().norm() <= distinction.distance_m)
    where += fmt::format(" and turned by {:.0f} deg", off.yaw_rad / kRadPerDeg);
  lose(fmt::format("what is seen fits {}, {:.0f} % of it; {:.0f} % here", where, 100.0 * best.explained,
                   100.0 * lost_test.explained()));
}

void Localizer::Impl::lose(std::string reason) {
  enter(was_localized ? LocalizationState::kLost : LocalizationState::kGlobal, std::move(reason));
  candidate.reset();
  request.reset();
  searched_path_length_m.reset();
  patience.begin(tracker.path_length_m());
  lost_test.reset();
  fits_nowhere = false;
  places = 0;
}

/// Extends the local map and requests a search of the whole map when it is due.
void Localizer::Impl::find(const LocalizationInput& input) {
  if (!local_map.empty() && !tracker.generationDue(input.T_odom_body)) return;
  local_map.add(tracker.T_odom_body(), input.scan.points_level_m);
  tracker.countGenerationsFromHere();
  const double here_m = tracker.path_length_m();
  if (searched_path_length_m && here_m - *searched_path_length_m < patience.spacing_m(here_m)) return;
  searched_path_length_m = here_m;
  requestSearch(input.scan);
}

void Localizer::Impl::requestSearch(const ProjectedScan& scan) {
  request = SearchRequest{scan.points_level_m, tracker.T_odom_body(), tracker.path_length_m()};
}

void Localizer::Impl::forgetSearches() {
  request.reset();
  ++epoch;
}

void Localizer::Impl::apply(const LocalizationResult::Data& found) {
  const LocalizationTask::Data& task = *found.task;
  if (task.epoch != epoch || task.doubted != (state == LocalizationState::kLocalized)) return;
  if (task.doubted) {
    if (found.enough_points) lookElsewhere(found);
  } else if (found.enough_points) {
    judge(found);
  } else {
    searched_path_length_m.reset();  // Retry as soon as there are more points.
  }
}

void Localizer::Impl::judge(const LocalizationResult::Data& found) {
  map_doubt.add(found.places, found.complete, found.task->path_length_m, now);
  if (found.places.empty() && !found.complete) {
    places = 0;
    fits_nowhere = false;
    candidate.reset();
    likely.clear();
    tracker.particles().spreadOverFreeSpace();
    enter(LocalizationState::kAmbiguous, "more places explain what was seen than can be told apart");
    return;
  }
  if (found.places.empty() || found.places.front().explained < kLeastExplained) {
    fitsNowhere();
    return;
  }
  places = static_cast<int>(found.places.size());
  const LikelyPlace& best = found.places.front();
  if (found.complete) patience.found(found.task->path_length_m, found.places.size());
  const Pose2& T_odom_middle = found.whole.T_odom_middle;
  likely.set(found.places, T_odom_middle);
  fits_nowhere = false;
  const Pose2 T_middle_body = T_odom_middle.inverse() * tracker.T_odom_body();
  std::vector<PoseHypothesis> hypotheses;
  for (const LikelyPlace& place : found.places)
    hypotheses.push_back({place.T_grid_points * T_middle_body, kPlaceCovariance, place.probability});
  tracker.particles().spreadAround(hypotheses);

  if (!found.complete || best.probability < 1.0 - config.ambiguity) {
    candidate.reset();
    enter(LocalizationState::kAmbiguous,
          fmt::format("{}{} places explain what was seen", found.complete ? "" : "more than ", found.places.size()));
    return;
  }
  places = 1;
  keepCandidate(best.T_grid_points * T_odom_middle.inverse(), found.task->path_length_m);
  // The last scan alone must agree as well.
  support = supportOf(*map, found.task->scan_body_m, candidate->T_grid_odom * found.task->T_odom_scan);
  if (found.task->path_length_m - candidate->path_length_m >= config.confirm_distance_m &&
      lost_test.logOdds(support) <= 0.0 && !map_doubt.refuted()) {
    localize(best, T_odom_middle);
    return;
  }
  enter(LocalizationState::kAmbiguous, "one place explains what was seen; not held for long yet");
}

void Localizer::Impl::fitsNowhere() {
  places = 0;
  candidate.reset();
  likely.clear();
  if (!fits_nowhere) nowhere_path_length_m = tracker.path_length_m();
  fits_nowhere = true;
  tracker.particles().spreadOverFreeSpace();
  // The vehicle may have been carried elsewhere, so the local map starts again from here.
  if (tracker.path_length_m() - nowhere_path_length_m > config.confirm_distance_m) {
    local_map.clear();
    fits_nowhere = false;
  }
  if (state == LocalizationState::kAmbiguous)
    enter(was_localized ? LocalizationState::kLost : LocalizationState::kGlobal, "what was seen fits nowhere");
}

void Localizer::Impl::keepCandidate(const Pose2& next_T_grid_odom, double at_path_length_m) {
  const Pose2& T_odom_body = tracker.T_odom_body();
  if (candidate && distinction.same(candidate->T_grid_odom * T_odom_body, next_T_grid_odom * T_odom_body))
    candidate->T_grid_odom = next_T_grid_odom;
  else
    candidate = Candidate{next_T_grid_odom, at_path_length_m};
}

void Localizer::Impl::localize(const LikelyPlace& place, const Pose2& T_odom_middle) {
  tracker.placeAt(place.T_grid_points * T_odom_middle.inverse(), kPlaceCovariance);
  enter(LocalizationState::kLocalized, fmt::format("one place explains {:.0f} % of what was seen over {:.1f} m",
                                                   100.0 * place.explained, local_map.length_m()));
  was_localized = true;
  forgetAll();
}

LocalizationEstimate Localizer::Impl::estimate() {
  LocalizationEstimate estimate;
  estimate.state = state;
  estimate.explained = support.explained;
  estimate.event = std::exchange(event, std::nullopt);
  if (estimate.event) estimate.event->stamp = now;
  estimate.refuted = map_doubt.refuted();
  estimate.places = state == LocalizationState::kLocalized ? 1 : places;
  if (state != LocalizationState::kLocalized) {
    estimate.candidates = likely.at(T_map_grid, tracker.T_odom_body());
    return estimate;
  }
  estimate.T_map_odom = T_map_grid * tracker.T_grid_odom();
  estimate.T_map_body = estimate.T_map_odom * tracker.T_odom_body();
  estimate.covariance = common::turned(tracker.covariance(), T_map_grid.yaw_rad);
  return estimate;
}

Localizer::Localizer(const common::OccupancyGrid& grid, const Pose2& T_map_grid, const LocalizerConfig& config,
                     std::uint64_t seed)
    : impl_(std::make_unique<Impl>(grid, T_map_grid, config, seed)) {
  SWIFTLET_CHECK(impl_->map->hasWalls() && impl_->map->freeCells() > 0);
  impl_->tracker.particles().spreadOverFreeSpace();
}
Localizer::~Localizer() = default;
Localizer::Localizer(Localizer&&) noexcept = default;
Localizer& Localizer::operator=(Localizer&&) noexcept = default;

void Localizer::startAt(const Pose2& T_map_body, const Eigen::Matrix3d& covariance) {
  Impl& self = *impl_;
  const Pose2 T_grid_body = self.T_map_grid.inverse() * T_map_body;
  self.tracker.startAt({T_grid_body, common::turned(covariance, -self.T_map_grid.yaw_rad), 1.0});
  self.enter(LocalizationState::kLocalized, "given");
  self.was_localized = true;
  self.map_doubt.reset();
  self.forgetAll();
}

void Localizer::forget() {
  Impl& self = *impl_;
  self.lose({});
  self.forgetAll();
  self.was_localized = false;
  self.map_doubt.reset();
  self.tracker.particles().spreadOverFreeSpace();
  self.event.reset();
}

bool Localizer::wantsFreshScan(const Pose2& T_odom_body) const {
  const Impl& self = *impl_;
  return self.state == LocalizationState::kLocalized && self.tracker.begun() && self.tracker.generationDue(T_odom_body);
}

LocalizationEstimate Localizer::add(const LocalizationInput& input) {
  LocalizationEstimate followed = follow(input);
  const auto task = takeTask();
  if (!task) return followed;
  LocalizationEstimate estimate = apply(run(*task));
  if (!estimate.event) estimate.event = std::move(followed.event);
  return estimate;
}

LocalizationEstimate Localizer::follow(const LocalizationInput& given) {
  Impl& self = *impl_;
  self.skipped.add(given);
  if (!isFinite(given.T_odom_body)) return self.estimate();
  const LocalizationInput input = self.skipped.included(given);
  self.support = {};
  self.step(input);
  if (self.state == LocalizationState::kLocalized)
    self.track(input);
  else
    self.find(input);
  return self.estimate();
}

std::optional<LocalizationTask> Localizer::takeTask() {
  Impl& self = *impl_;
  if (self.searching || !self.request || self.local_map.empty()) return std::nullopt;
  auto data = std::make_shared<LocalizationTask::Data>();
  data->epoch = self.epoch;
  data->doubted = self.state == LocalizationState::kLocalized;
  data->local_map = self.local_map;
  data->scan_body_m = std::move(self.request->scan_body_m);
  data->T_odom_scan = self.request->T_odom_scan;
  data->path_length_m = self.request->path_length_m;
  data->config = self.config;
  data->map = self.map;
  data->search = self.search;
  self.request.reset();
  self.searching = true;
  return LocalizationTask{std::move(data)};
}

LocalizationEstimate Localizer::apply(const LocalizationResult& result) {
  impl_->searching = false;
  impl_->apply(*result.data);
  return impl_->estimate();
}

LocalizationState Localizer::state() const { return impl_->state; }

}  // namespace swiftlet::perception
