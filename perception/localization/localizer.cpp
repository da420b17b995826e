#include "perception/localization/localizer.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "common/check.hpp"
#include "common/validation.hpp"
#include "perception/localization/place_posterior.hpp"

namespace swiftlet::perception {

using common::kRadPerDeg;
using common::Pose2;

namespace {

/// How far particles are spread about a place that was found: what its search left open.
const Eigen::Matrix3d kPlaceCovariance =
    Eigen::Vector3d(0.05 * 0.05, 0.05 * 0.05, 1.0 * kRadPerDeg * 1.0 * kRadPerDeg).asDiagonal();
/// Particles never move all alike, or they would become one.
constexpr double kLeastNoise_m = 0.01;
constexpr double kLeastNoise_rad = 0.2 * kRadPerDeg;
/// Of the odometry's turns.
constexpr double kTurnShare = 0.02;

double square(double value) { return value * value; }

double sigma_m(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> position(covariance.topLeftCorner<2, 2>().eval(),
                                                                Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, position.eigenvalues()(1)));
}

}  // namespace

const char* toString(LocalizationState state) {
  switch (state) {
    case LocalizationState::kGlobal:
      return "global";
    case LocalizationState::kAmbiguous:
      return "ambiguous";
    case LocalizationState::kLocalized:
      return "localized";
    case LocalizationState::kLost:
      return "lost";
  }
  return "?";
}

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
        search(map, config_in.search),
        local_map(config_in.local_map_length_m),
        lost_test(config_in.lost),
        distinction{config_in.search.distinct_m, config_in.search.distinct_deg * kRadPerDeg} {}

  void step(const LocalizationInput& input);
  bool generationDue(const Pose2& T_odom_body) const;
  void follow(const LocalizationInput& input);
  Eigen::Matrix3d covarianceNow() const;
  void generate(const ProjectedScan& scan);
  void doubt(const LocalizationInput& input);
  void lookElsewhere();
  void lose(std::string reason);
  void find(const LocalizationInput& input);
  std::vector<LikelyPlace> placesOf(const LocalMap::Whole& whole, bool& complete);
  void judge(const std::vector<LikelyPlace>& places, bool complete, const Pose2& T_odom_middle,
             const ProjectedScan& scan);
  void keepCandidate(const Pose2& T_grid_odom);
  void localize(const LikelyPlace& place, const Pose2& T_odom_middle);
  void enter(LocalizationState next, std::string reason);

  LocalizerConfig config;
  Pose2 T_map_grid;
  std::shared_ptr<const MapField> map;
  ParticleFilter filter;
  GlobalSearch search;
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
  const Eigen::Matrix3d own = common::turned(input.step_covariance + Eigen::Matrix3d(least.asDiagonal()),
                                             between(T_odom_generation, T_odom_body).yaw_rad);
  step_covariance = common::propagated(step_covariance, between(T_odom_generation, T_odom_body),
                                       between(T_odom_generation, input.T_odom_body), own);
  way_m += distance_m;
  turned_rad += turn_rad;
  T_odom_body = input.T_odom_body;
  if (!input.interrupted) return;
  local_map.clear();
  candidate.reset();
  lost_test.reset();
}

bool Localizer::Impl::generationDue(const Pose2& next_T_odom_body) const {
  const Pose2 ahead = between(T_odom_body, next_T_odom_body);
  return generation_forced || way_m - generation_way_m + ahead.position_m().norm() >= config.generation_distance_m ||
         turned_rad - generation_turned_rad + std::abs(common::wrapAngle(ahead.yaw_rad)) >=
             config.generation_turn_deg * kRadPerDeg;
}

void Localizer::Impl::follow(const LocalizationInput& input) {
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
  if (since_search_s >= config.doubt_search_s) lookElsewhere();
}

void Localizer::Impl::lookElsewhere() {
  since_search_s = 0.0;
  const LocalMap::Whole whole =
      local_map.whole(config.local_map_spacing_m, static_cast<std::size_t>(config.local_map_points));
  if (static_cast<int>(whole.points_middle_m.size()) < config.local_map_least_points) return;
  bool complete = true;
  const std::vector<LikelyPlace> found = placesOf(whole, complete);
  if (found.empty() || found.front().explained < config.least_explained) return;
  const Pose2 here = T_grid_odom * whole.T_odom_middle;
  if (distinction.same(found.front().T_grid_points, here)) return;
  const double gain =
      found.front().log_likelihood - logLikelihood(*map, whole.points_middle_m, here, config.point_weight);
  if (gain >= config.elsewhere_nats)
    lose(fmt::format("what is seen fits {:.1f} m away, {:.0f} % of it; {:.0f} % here",
                     (found.front().T_grid_points.position_m() - here.position_m()).norm(),
                     100.0 * found.front().explained, 100.0 * lost_test.explained()));
}

void Localizer::Impl::lose(std::string reason) {
  enter(LocalizationState::kLost, std::move(reason));
  candidate.reset();
  searched_way_m.reset();
  lost_test.reset();
  fits_nowhere = false;
  places = 0;
}

std::vector<LikelyPlace> Localizer::Impl::placesOf(const LocalMap::Whole& whole, bool& complete) {
  // What cannot be told from the best may be missing among the places, not what can.
  const auto count = static_cast<double>(whole.points_middle_m.size());
  const double nats = std::log(config.search.max_places / std::max(config.ambiguity, 1e-6));
  constexpr double kCoarseness = 0.05;  // By how much the coarse field may misjudge a fit.
  const GlobalSearchResult found =
      search.search(whole.points_middle_m, kCoarseness + nats / (config.point_weight * map->topNats() * count));
  complete = found.complete;
  return likelyPlaces(bestInstructions(), *map, found.places, whole.points_middle_m, config.point_weight,
                      config.support.tolerance_m, distinction);
}

/// The local map grows; the particles are all the places where it fits.
void Localizer::Impl::find(const LocalizationInput& input) {
  if (!local_map.empty() && !generationDue(input.T_odom_body)) return;
  local_map.add(T_odom_body, input.scan.points_level_m);
  generation_way_m = way_m;
  generation_turned_rad = turned_rad;
  if (searched_way_m && way_m - *searched_way_m < config.search_distance_m) return;
  const LocalMap::Whole whole =
      local_map.whole(config.local_map_spacing_m, static_cast<std::size_t>(config.local_map_points));
  if (static_cast<int>(whole.points_middle_m.size()) < config.local_map_least_points) return;
  searched_way_m = way_m;
  bool complete = true;
  const std::vector<LikelyPlace> found = placesOf(whole, complete);
  judge(found, complete, whole.T_odom_middle, input.scan);
}

void Localizer::Impl::judge(const std::vector<LikelyPlace>& found, bool complete, const Pose2& T_odom_middle,
                            const ProjectedScan& scan) {
  places = static_cast<int>(found.size());
  if (found.empty() || found.front().explained < config.least_explained) {
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
    return;
  }
  fits_nowhere = false;
  const Pose2 T_middle_body = T_odom_middle.inverse() * T_odom_body;
  std::vector<PoseHypothesis> hypotheses;
  for (const LikelyPlace& place : found)
    hypotheses.push_back({place.T_grid_points * T_middle_body, kPlaceCovariance, place.probability});
  filter.spreadAround(hypotheses);

  const bool single = complete && found.front().probability >= 1.0 - config.ambiguity;
  if (!single) {
    candidate.reset();
    enter(LocalizationState::kAmbiguous,
          fmt::format("{}{} places explain what was seen", complete ? "" : "more than ", found.size()));
    return;
  }
  places = 1;
  keepCandidate(found.front().T_grid_points * T_odom_middle.inverse());
  // The last scan alone must not speak against it, either.
  support = supportOf(*map, scan.points_level_m, candidate->T_grid_odom * T_odom_body, config.support);
  if (way_m - candidate->way_m >= config.confirm_distance_m && lost_test.logOdds(support) <= 0.0) {
    localize(found.front(), T_odom_middle);
    return;
  }
  enter(LocalizationState::kAmbiguous, "one place explains what was seen; not held for long yet");
}

void Localizer::Impl::keepCandidate(const Pose2& next_T_grid_odom) {
  if (candidate && distinction.same(candidate->T_grid_odom * T_odom_body, next_T_grid_odom * T_odom_body))
    candidate->T_grid_odom = next_T_grid_odom;
  else
    candidate = Candidate{next_T_grid_odom, way_m};
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
  lost_test.reset();
  candidate.reset();
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
  if (!self.begun) return;
  self.T_grid_odom = T_grid_body * self.T_odom_body.inverse();
  self.start.reset();
}

bool Localizer::wantsFreshScan(const Pose2& T_odom_body) const {
  const Impl& self = *impl_;
  return self.state == LocalizationState::kLocalized && self.begun && self.generationDue(T_odom_body);
}

LocalizationEstimate Localizer::add(const LocalizationInput& input) {
  Impl& self = *impl_;
  self.support = {};
  self.step(input);
  if (self.state == LocalizationState::kLocalized)
    self.follow(input);
  else
    self.find(input);

  LocalizationEstimate estimate;
  estimate.state = self.state;
  estimate.doubt = self.lost_test.sum();
  estimate.explained = self.support.explained;
  estimate.event = std::exchange(self.event, std::nullopt);
  if (estimate.event) estimate.event->stamp = input.scan.stamp;
  if (self.state != LocalizationState::kLocalized) {
    estimate.places = self.places;
    return estimate;
  }
  estimate.places = 1;
  estimate.T_map_odom = self.T_map_grid * self.T_grid_odom;
  estimate.T_map_body = estimate.T_map_odom * self.T_odom_body;
  estimate.covariance = common::turned(self.covarianceNow(), self.T_map_grid.yaw_rad);
  return estimate;
}

LocalizationState Localizer::state() const { return impl_->state; }

std::vector<Pose2> Localizer::particles() const {
  std::vector<Pose2> poses;
  for (std::size_t i = 0; i < impl_->filter.size(); ++i) poses.push_back(impl_->T_map_grid * impl_->filter.particle(i));
  return poses;
}

}  // namespace swiftlet::perception
