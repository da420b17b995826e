#include "perception/localization/localizer.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "common/check.hpp"
#include "common/square.hpp"
#include "common/validation.hpp"
#include "perception/localization/place_posterior.hpp"

namespace swiftlet::perception {

using common::kRadPerDeg;
using common::Pose2;
using common::square;

namespace {

/// How far particles are spread about a place that was found: what its search left open.
const Eigen::Matrix3d kPlaceCovariance =
    Eigen::Vector3d(0.05 * 0.05, 0.05 * 0.05, 1.0 * kRadPerDeg * 1.0 * kRadPerDeg).asDiagonal();
/// Particles never move all alike, or they would become one.
constexpr double kLeastNoise_m = 0.01;
constexpr double kLeastNoise_rad = 0.2 * kRadPerDeg;
/// Of the odometry's turns.
constexpr double kTurnShare = 0.02;

/// How far an odometry that lost the thread can be off, relative to where it is believed to be.
const Eigen::Matrix3d kBreakCovariance = Eigen::Vector3d(0.5 * 0.5, 0.5 * 0.5, 0.3 * 0.3).asDiagonal();

PlaceDistinction distinctionOf(const LocalizerConfig& config) {
  return {config.search.distinct_m, config.search.distinct_deg * kRadPerDeg};
}

double sigma_m(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> position(covariance.topLeftCorner<2, 2>().eval(),
                                                                Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, position.eigenvalues()(1)));
}

}  // namespace

/// As it was when the search was asked for.
struct LocalizationTask::Data {
  std::uint64_t epoch = 0;
  bool doubted = false;  ///< It is believed to be somewhere, and looked for elsewhere.
  LocalMap local_map{0.0};
  std::vector<Eigen::Vector2f> scan_body_m;
  Pose2 T_odom_scan;
  double way_m = 0.0;
  LocalizerConfig config;
  std::shared_ptr<const MapField> map;
  std::shared_ptr<GlobalSearch> search;  ///< Of this task alone as long as it has not been applied.
};

struct LocalizationResult::Data {
  std::shared_ptr<const LocalizationTask::Data> task;
  LocalMap::Whole whole;
  bool enough_points = false;
  std::vector<LikelyPlace> places;
  bool complete = true;
};

LocalizerConfig::LocalizerConfig() = default;

void LocalizerConfig::describe(common::config::Fields& fields) {
  fields.section("particles", particles, "The particle filter that follows the pose.");
  fields.section("search", search, "The search of the whole map.");
  fields.section("support", support, "How much of a scan the map explains.");
  fields.section("lost", lost, "When the pose is no longer believed.");
  fields("generation_distance_m", generation_distance_m, "Way after which particles are weighed and drawn anew.");
  fields("generation_turn_deg", generation_turn_deg, "Turn after which they are.");
  fields("odometry_share", odometry_share, "Least error of the odometry, of the way.");
  fields("odometry_deg_per_m", odometry_deg_per_m, "Least error of its heading.");
  fields("max_sigma_m", max_sigma_m, "A pose less certain than this is not known.");
  fields("local_map_length_m", local_map_length_m, "Way that is kept until the pose is known.");
  fields("local_map_spacing_m", local_map_spacing_m, "Between points of the local map.");
  fields("local_map_points", local_map_points, "Points that are compared with the map.");
  fields("local_map_least_points", local_map_least_points, "With fewer nothing is concluded.");
  fields("search_distance_m", search_distance_m, "The whole map is searched again after so much way.");
  fields("point_weight", point_weight, "Weight of one point in the likelihood.");
  fields("ambiguity", ambiguity, "Probability of all other places at which a pose is not believed.");
  fields("least_explained", least_explained, "Share of the local map that the map must explain.");
  fields("confirm_distance_m", confirm_distance_m, "Way over which a pose must hold.");
  fields("doubt_search_s", doubt_search_s, "In doubt, the whole map is searched this often.");
  fields("elsewhere_nats", elsewhere_nats, "So much likelier elsewhere means lost.");
}

std::vector<std::string> LocalizerConfig::validate() const {
  return common::Validation()
      .within("generation_distance_m", generation_distance_m, 0.01, 10)
      .within("generation_turn_deg", generation_turn_deg, 0.1, 180)
      .within("odometry_share", odometry_share, 0, 1)
      .within("odometry_deg_per_m", odometry_deg_per_m, 0, 90)
      .within("max_sigma_m", max_sigma_m, 0.05, 100)
      .within("local_map_length_m", local_map_length_m, 1, 1000)
      .within("local_map_spacing_m", local_map_spacing_m, 0.01, 5)
      .within("local_map_points", local_map_points, 10, kMaxWindowPoints)
      .within("local_map_least_points", local_map_least_points, 5, local_map_points)
      .within("search_distance_m", search_distance_m, 0, 100)
      .within("point_weight", point_weight, 0.001, 1)
      .within("ambiguity", ambiguity, 0, 1)
      .within("least_explained", least_explained, 0, 1)
      .within("confirm_distance_m", confirm_distance_m, 0, 100)
      .within("doubt_search_s", doubt_search_s, 0, 100)
      .within("elsewhere_nats", elsewhere_nats, 0, 1000)
      .problems();
}

struct Localizer::Impl {
  Impl(const common::OccupancyGrid& grid, const Pose2& T_map_grid_in, const LocalizerConfig& config_in,
       std::uint64_t seed)
      : config(config_in),
        T_map_grid(T_map_grid_in),
        map(std::make_shared<const MapField>(grid, config_in.field)),
        filter(map, config_in.particles, seed),
        search(std::make_shared<GlobalSearch>(map, config_in.search)),
        local_map(config_in.local_map_length_m),
        lost_test(config_in.lost),
        distinction(distinctionOf(config_in)) {}

  void step(const LocalizationInput& input);
  bool generationDue(const Pose2& T_odom_body) const;
  void track(const LocalizationInput& input);
  Eigen::Matrix3d covarianceNow() const;
  void generate(const ProjectedScan& scan);
  void doubt(const LocalizationInput& input);
  void lookElsewhere(const LocalizationResult::Data& found);
  void lose(std::string reason);
  void find(const LocalizationInput& input);
  void ask(const ProjectedScan& scan);
  void forgetSearches();
  void apply(const LocalizationResult::Data& found);
  void judge(const LocalizationResult::Data& found);
  void fitsNowhere();
  void keepCandidate(const Pose2& T_grid_odom, double at_way_m);
  void localize(const LikelyPlace& place, const Pose2& T_odom_middle);
  void enter(LocalizationState next, std::string reason);
  LocalizationEstimate estimate();

  LocalizerConfig config;
  Pose2 T_map_grid;
  std::shared_ptr<const MapField> map;
  ParticleFilter filter;
  std::shared_ptr<GlobalSearch> search;
  LocalMap local_map;
  LostTest lost_test;
  PlaceDistinction distinction;

  LocalizationState state = LocalizationState::kGlobal;
  bool was_localized = false;
  bool begun = false;
  bool generation_forced = false;
  common::Time now;
  double elapsed_s = 0.0;
  double way_m = 0.0;  ///< Travelled, by the odometry.
  double turned_rad = 0.0;
  Pose2 T_odom_body;
  ScanSupport support;
  int places = 0;

  // While localized.
  Pose2 T_grid_odom;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::optional<PoseHypothesis> start;
  Pose2 T_odom_generation;                                     ///< Where the particles are.
  Eigen::Matrix3d step_covariance = Eigen::Matrix3d::Zero();   ///< Since then, axes of the body then.
  double generation_way_m = 0.0, generation_turned_rad = 0.0;  ///< At that moment.
  double since_search_s = 0.0;

  // While not.
  struct Candidate {
    Pose2 T_grid_odom;
    double way_m = 0.0;  ///< Where it was first the only place.
  };
  std::optional<Candidate> candidate;
  std::optional<double> searched_way_m;  ///< At the last search.
  double nowhere_way_m = 0.0;            ///< Since when the local map fits nowhere.
  bool fits_nowhere = false;

  // The search that is asked for, and the one that is under way.
  struct Question {
    std::vector<Eigen::Vector2f> scan_body_m;
    Pose2 T_odom_scan;
    double way_m = 0.0;
  };
  std::optional<Question> question;
  bool searching = false;
  std::uint64_t epoch = 0;  ///< What was searched for in an earlier one no longer counts.

  std::optional<LocalizationEvent> event;
};

void Localizer::Impl::enter(LocalizationState next, std::string reason) {
  if (next == state) return;
  state = next;
  event = LocalizationEvent{now, next, std::move(reason)};
}

/// Odometry since the last input, with its errors.
void Localizer::Impl::step(const LocalizationInput& input) {
  elapsed_s = begun ? std::max(0.0, (input.scan.stamp - now).seconds()) : 0.0;
  now = input.scan.stamp;
  if (!begun) {
    T_odom_body = T_odom_generation = input.T_odom_body;
    begun = true;
    if (!start) return;
    T_grid_odom = start->T_grid_body * T_odom_body.inverse();
    start.reset();
    return;
  }
  const Pose2 moved = between(T_odom_body, input.T_odom_body);
  const double distance_m = moved.position_m().norm(), turn_rad = std::abs(common::wrapAngle(moved.yaw_rad));
  const Eigen::Vector3d least(
      square(config.odometry_share * distance_m), square(config.odometry_share * distance_m),
      square(config.odometry_deg_per_m * kRadPerDeg * distance_m) + square(kTurnShare * turn_rad));
  Eigen::Matrix3d measured = input.step_covariance;
  if (input.interrupted) measured += kBreakCovariance;
  const Eigen::Matrix3d own =
      common::turned(measured + Eigen::Matrix3d(least.asDiagonal()), between(T_odom_generation, T_odom_body).yaw_rad);
  step_covariance = common::propagated(step_covariance, between(T_odom_generation, T_odom_body),
                                       between(T_odom_generation, input.T_odom_body), own);
  way_m += distance_m;
  turned_rad += turn_rad;
  T_odom_body = input.T_odom_body;
  if (!input.interrupted) return;
  local_map.clear();
  forgetSearches();
  candidate.reset();
  lost_test.reset();
}

bool Localizer::Impl::generationDue(const Pose2& next_T_odom_body) const {
  const Pose2 ahead = between(T_odom_body, next_T_odom_body);
  return generation_forced || way_m - generation_way_m + ahead.position_m().norm() >= config.generation_distance_m ||
         turned_rad - generation_turned_rad + std::abs(common::wrapAngle(ahead.yaw_rad)) >=
             config.generation_turn_deg * kRadPerDeg;
}

void Localizer::Impl::track(const LocalizationInput& input) {
  if (input.fresh && generationDue(input.T_odom_body)) generate(input.scan);
  if (generation_forced) return;  // The pose that was given is only roughly right.
  doubt(input);
  const double uncertain_m = sigma_m(covarianceNow());
  if (state == LocalizationState::kLocalized && uncertain_m > config.max_sigma_m)
    lose(fmt::format("the pose is uncertain by {:.1f} m", uncertain_m));
}

/// Of the pose that the odometry has led to since the particles were drawn; axes of the grid.
Eigen::Matrix3d Localizer::Impl::covarianceNow() const {
  const Pose2 T_grid_generation = T_grid_odom * T_odom_generation;
  return propagated(covariance, T_grid_generation, T_grid_odom * T_odom_body,
                    common::turned(step_covariance, T_grid_generation.yaw_rad));
}

/// Predict, weigh, draw anew, take the mean.
void Localizer::Impl::generate(const ProjectedScan& scan) {
  const Eigen::Vector3d least(square(kLeastNoise_m), square(kLeastNoise_m), square(kLeastNoise_rad));
  filter.move(between(T_odom_generation, T_odom_body), step_covariance + Eigen::Matrix3d(least.asDiagonal()));
  filter.weigh(scan.points_level_m);
  filter.resample();
  const ParticleFilter::Estimate estimate = filter.estimate();
  T_grid_odom = estimate.T_grid_body * T_odom_body.inverse();
  covariance = estimate.covariance;
  T_odom_generation = T_odom_body;
  step_covariance.setZero();
  generation_way_m = way_m;
  generation_turned_rad = turned_rad;
  generation_forced = false;
}

/// Once in doubt, what is seen from then on is kept and looked for in the whole map.
void Localizer::Impl::doubt(const LocalizationInput& input) {
  support = supportOf(*map, input.scan.points_level_m, T_grid_odom * T_odom_body, config.support);
  const bool doubted = lost_test.doubtful();
  lost_test.add(support, elapsed_s);
  if (!lost_test.doubtful()) {
    if (!local_map.empty()) forgetSearches();
    local_map.clear();
    return;
  }
  if (!doubted) since_search_s = config.doubt_search_s;
  const bool moved = local_map.empty() || (between(local_map.T_odom_last(), T_odom_body).position_m().norm() >=
                                           config.generation_distance_m);
  if (moved) local_map.add(T_odom_body, input.scan.points_level_m);
  if (lost_test.lost()) {
    lose(fmt::format("the map explains {:.0f} % of what is seen", 100.0 * lost_test.explained()));
    return;
  }
  since_search_s += elapsed_s;
  if (since_search_s < config.doubt_search_s) return;
  since_search_s = 0.0;
  ask(input.scan);
}

void Localizer::Impl::lookElsewhere(const LocalizationResult::Data& found) {
  if (found.places.empty() || found.places.front().explained < config.least_explained) return;
  const LikelyPlace& best = found.places.front();
  const Pose2 here = T_grid_odom * found.whole.T_odom_middle;
  if (distinction.same(best.T_grid_points, here)) return;
  const double gain = best.log_likelihood - logLikelihood(*map, found.whole.points_middle_m, here, config.point_weight);
  if (gain >= config.elsewhere_nats)
    lose(fmt::format("what is seen fits {:.1f} m away, {:.0f} % of it; {:.0f} % here",
                     (best.T_grid_points.position_m() - here.position_m()).norm(), 100.0 * best.explained,
                     100.0 * lost_test.explained()));
}

void Localizer::Impl::lose(std::string reason) {
  enter(LocalizationState::kLost, std::move(reason));
  candidate.reset();
  question.reset();
  searched_way_m.reset();
  lost_test.reset();
  fits_nowhere = false;
  places = 0;
}

/// The local map grows; the particles are all the places where it fits.
void Localizer::Impl::find(const LocalizationInput& input) {
  if (!local_map.empty() && !generationDue(input.T_odom_body)) return;
  local_map.add(T_odom_body, input.scan.points_level_m);
  generation_way_m = way_m;
  generation_turned_rad = turned_rad;
  if (searched_way_m && way_m - *searched_way_m < config.search_distance_m) return;
  searched_way_m = way_m;
  ask(input.scan);
}

void Localizer::Impl::ask(const ProjectedScan& scan) { question = Question{scan.points_level_m, T_odom_body, way_m}; }

void Localizer::Impl::forgetSearches() {
  question.reset();
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
    searched_way_m.reset();  // Again, as soon as there is more.
  }
}

void Localizer::Impl::judge(const LocalizationResult::Data& found) {
  places = static_cast<int>(found.places.size());
  if (found.places.empty() || found.places.front().explained < config.least_explained) {
    fitsNowhere();
    return;
  }
  const LikelyPlace& best = found.places.front();
  const Pose2& T_odom_middle = found.whole.T_odom_middle;
  fits_nowhere = false;
  const Pose2 T_middle_body = T_odom_middle.inverse() * T_odom_body;
  std::vector<PoseHypothesis> hypotheses;
  for (const LikelyPlace& place : found.places)
    hypotheses.push_back({place.T_grid_points * T_middle_body, kPlaceCovariance, place.probability});
  filter.spreadAround(hypotheses);

  if (!found.complete || best.probability < 1.0 - config.ambiguity) {
    candidate.reset();
    enter(LocalizationState::kAmbiguous,
          fmt::format("{}{} places explain what was seen", found.complete ? "" : "more than ", found.places.size()));
    return;
  }
  places = 1;
  keepCandidate(best.T_grid_points * T_odom_middle.inverse(), found.task->way_m);
  // The last scan alone must not speak against it, either.
  support = supportOf(*map, found.task->scan_body_m, candidate->T_grid_odom * found.task->T_odom_scan, config.support);
  if (found.task->way_m - candidate->way_m >= config.confirm_distance_m && lost_test.logOdds(support) <= 0.0) {
    localize(best, T_odom_middle);
    return;
  }
  enter(LocalizationState::kAmbiguous, "one place explains what was seen; not held for long yet");
}

void Localizer::Impl::fitsNowhere() {
  candidate.reset();
  if (!fits_nowhere) nowhere_way_m = way_m;
  fits_nowhere = true;
  filter.spreadOverFreeSpace();
  // It may have been carried away meanwhile: begin anew from here.
  if (way_m - nowhere_way_m > config.confirm_distance_m) {
    local_map.clear();
    fits_nowhere = false;
  }
  if (state == LocalizationState::kAmbiguous)
    enter(was_localized ? LocalizationState::kLost : LocalizationState::kGlobal, "what was seen fits nowhere");
}

void Localizer::Impl::keepCandidate(const Pose2& next_T_grid_odom, double at_way_m) {
  if (candidate && distinction.same(candidate->T_grid_odom * T_odom_body, next_T_grid_odom * T_odom_body))
    candidate->T_grid_odom = next_T_grid_odom;
  else
    candidate = Candidate{next_T_grid_odom, at_way_m};
}

void Localizer::Impl::localize(const LikelyPlace& place, const Pose2& T_odom_middle) {
  T_grid_odom = place.T_grid_points * T_odom_middle.inverse();
  covariance = kPlaceCovariance;
  T_odom_generation = T_odom_body;
  step_covariance.setZero();
  enter(LocalizationState::kLocalized, fmt::format("one place explains {:.0f} % of what was seen over {:.1f} m",
                                                   100.0 * place.explained, local_map.length_m()));
  was_localized = true;
  local_map.clear();
  question.reset();
  lost_test.reset();
  candidate.reset();
}

LocalizationEstimate Localizer::Impl::estimate() {
  LocalizationEstimate estimate;
  estimate.state = state;
  estimate.doubt = lost_test.sum();
  estimate.explained = support.explained;
  estimate.event = std::exchange(event, std::nullopt);
  if (estimate.event) estimate.event->stamp = now;
  estimate.places = state == LocalizationState::kLocalized ? 1 : places;
  if (state != LocalizationState::kLocalized) return estimate;
  estimate.T_map_odom = T_map_grid * T_grid_odom;
  estimate.T_map_body = estimate.T_map_odom * T_odom_body;
  estimate.covariance = common::turned(covarianceNow(), T_map_grid.yaw_rad);
  return estimate;
}

LocalizationResult run(const LocalizationTask& task) {
  const LocalizationTask::Data& data = *task.data;
  const LocalizerConfig& config = data.config;
  auto result = std::make_shared<LocalizationResult::Data>();
  result->task = task.data;
  result->whole = data.local_map.whole(config.local_map_spacing_m, static_cast<std::size_t>(config.local_map_points));
  const std::vector<Eigen::Vector2f>& points = result->whole.points_middle_m;
  result->enough_points = static_cast<int>(points.size()) >= config.local_map_least_points;
  if (!result->enough_points) return {std::move(result)};
  // What cannot be told from the best must not be missing among the places: as many that fit worse still as there are
  // in a large building are together less likely than the ambiguity allows.
  constexpr double kOthers = 50.0;
  constexpr double kCoarseness = 0.05;  // By how much the coarse field may misjudge a fit.
  const double nats = std::log(kOthers / std::max(config.ambiguity, 1e-6));
  const double margin =
      kCoarseness + nats / (config.point_weight * data.map->topNats() * static_cast<double>(points.size()));
  const GlobalSearchResult found = data.search->search(points, margin);
  result->complete = found.complete;
  result->places = likelyPlaces(bestInstructions(), *data.map, found.places, points, config.point_weight,
                                config.support.tolerance_m, distinctionOf(config));
  return {std::move(result)};
}

Localizer::Localizer(const common::OccupancyGrid& grid, const Pose2& T_map_grid, const LocalizerConfig& config,
                     std::uint64_t seed)
    : impl_(std::make_unique<Impl>(grid, T_map_grid, config, seed)) {
  SWIFTLET_CHECK(impl_->map->hasWalls() && !impl_->map->freeCells_m().empty());
  impl_->filter.spreadOverFreeSpace();
}
Localizer::~Localizer() = default;
Localizer::Localizer(Localizer&&) noexcept = default;
Localizer& Localizer::operator=(Localizer&&) noexcept = default;

std::string Localizer::whyUnusable(const common::OccupancyGrid& map) {
  bool walls = false, free = false;
  map.forEachCell([&](common::CellIndex, common::occupancy::Cell cell) {
    walls |= common::occupancy::isOccupied(cell);
    free |= common::occupancy::isFree(cell);
  });
  if (!free) return "the map has no free cells: a vehicle can be nowhere in it";
  if (!walls) return "the map has no occupied cells: there is nothing to see in it";
  return "";
}

void Localizer::startAt(const Pose2& T_map_body, const Eigen::Matrix3d& covariance) {
  Impl& self = *impl_;
  const Pose2 T_grid_body = self.T_map_grid.inverse() * T_map_body;
  self.start = PoseHypothesis{T_grid_body, common::turned(covariance, -self.T_map_grid.yaw_rad), 1.0};
  self.filter.spreadAround(std::span(&*self.start, 1));
  self.covariance = self.start->covariance;
  self.enter(LocalizationState::kLocalized, "given");
  self.was_localized = self.generation_forced = true;
  self.forgetSearches();
  if (!self.begun) return;
  self.T_grid_odom = T_grid_body * self.T_odom_body.inverse();
  self.start.reset();
}

bool Localizer::wantsFreshScan(const Pose2& T_odom_body) const {
  const Impl& self = *impl_;
  return self.state == LocalizationState::kLocalized && self.begun && self.generationDue(T_odom_body);
}

LocalizationEstimate Localizer::add(const LocalizationInput& input) {
  LocalizationEstimate followed = follow(input);
  const auto task = takeTask();
  if (!task) return followed;
  LocalizationEstimate estimate = apply(run(*task));
  if (!estimate.event) estimate.event = std::move(followed.event);
  return estimate;
}

LocalizationEstimate Localizer::follow(const LocalizationInput& input) {
  Impl& self = *impl_;
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
  if (self.searching || !self.question || self.local_map.empty()) return std::nullopt;
  auto data = std::make_shared<LocalizationTask::Data>();
  data->epoch = self.epoch;
  data->doubted = self.state == LocalizationState::kLocalized;
  data->local_map = self.local_map;
  data->scan_body_m = std::move(self.question->scan_body_m);
  data->T_odom_scan = self.question->T_odom_scan;
  data->way_m = self.question->way_m;
  data->config = self.config;
  data->map = self.map;
  data->search = self.search;
  self.question.reset();
  self.searching = true;
  return LocalizationTask{std::move(data)};
}

LocalizationEstimate Localizer::apply(const LocalizationResult& result) {
  impl_->searching = false;
  impl_->apply(*result.data);
  return impl_->estimate();
}

LocalizationState Localizer::state() const { return impl_->state; }

std::vector<Pose2> Localizer::particles() const {
  std::vector<Pose2> poses;
  for (std::size_t i = 0; i < impl_->filter.size(); ++i) poses.push_back(impl_->T_map_grid * impl_->filter.particle(i));
  return poses;
}

}  // namespace swiftlet::perception
