#include "perception/scan_matching/correlative_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "common/small_matrices.hpp"
#include "perception/scan_matching/branch_and_bound.hpp"
#include "perception/scan_matching/likelihood_field.hpp"
#include "perception/scan_matching/reference_view.hpp"
#include "perception/scan_matching/resolution_mean.hpp"
#include "perception/scan_matching/scan_contour.hpp"
#include "perception/scan_matching/score_grid.hpp"
#include "perception/scan_matching/score_surface.hpp"
#include "perception/scan_matching/split_points.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Pose2;

/// Distance and rotation from the guess at which half of guess_weight is lost.
constexpr double kGuessDistance_m = 0.08, kGuessRotation_deg = 3.0;
/// Factor on the covariance of independent points, calibrated by tests/scan_matching/correlative_matcher_test.cpp.
constexpr double kSurfaceCovarianceScale = 1.5;
/// A direction less certain than this is not observed: the pose keeps the guess there.
constexpr double kSurfaceUnobservableSigma_m = 0.1;
/// The profile of the scores widens the covariance only if the contour facing the least constrained direction is a
/// smaller share than this.
constexpr double kProfiledSpread = 0.25;
constexpr double kTopValue = LikelihoodField::kTopValue;
/// Windows with more poses are searched by branch and bound even with kScoreGrid: this many scores take 80 MB.
constexpr double kMostScores = 2e7;
/// Points this close to the edge of the reference's view may lie outside it, because poses err and scores are blurred.
constexpr double kViewMargin_m = 0.15;
/// With a smaller share of the points in the view of the reference, the guess is probably wrong, so all points are
/// used (docs/decisions/scan_matching.md#021).
constexpr double kLeastInView = 0.25;
/// A match of a smaller share must fit better, as chance matches are likelier (docs/decisions/scan_matching.md#023).
constexpr double kUsuallyInView = 0.5;
/// Limit on the half width of a window, in steps.
constexpr double kMostSteps = 4000.0;

/// The steps that cover a half width; 0 for widths that are not positive, and for NaN.
int stepsIn(double half, double step, double most) {
  return half > 0.0 ? static_cast<int>(std::min(std::ceil(half / step), most)) : 0;
}

}  // namespace

struct CorrelativeMatcher::Impl {
  Impl(const CorrelativeMatcherConfig& config_in, Instructions instructions_in)
      : config(config_in),
        instructions(instructions_in),
        field(config_in.resolution_m, config_in.sigma_m),
        view(kMaxRange_m),
        search(instructions_in),
        all_scores(instructions_in) {}

  PoseGrid gridAround(const Pose2& guess, const SearchWindow& window) const {
    const double step_rad = config.angular_resolution_deg * kRadPerDeg;
    const int half = stepsIn(window.half_translation_m, config.resolution_m, kMostSteps);
    const int half_turn = stepsIn(window.half_rotation_rad, step_rad, std::floor(std::numbers::pi / step_rad));
    return {guess.x_m - half * config.resolution_m,
            guess.y_m - half * config.resolution_m,
            guess.yaw_rad - half_turn * step_rad,
            step_rad,
            2 * half_turn + 1,
            2 * half + 1};
  }

  GuessPenalty penaltyFor(std::size_t points) const {
    return {static_cast<int>(config.guess_weight * kTopValue * static_cast<double>(points)),
            kGuessDistance_m / config.resolution_m, kGuessRotation_deg / config.angular_resolution_deg};
  }

  Pose2 poseAt(const PoseGrid& grid, const BestPose& best) const {
    return {grid.first_x_m + best.x * config.resolution_m, grid.first_y_m + best.y * config.resolution_m,
            common::wrapAngle(grid.first_yaw_rad + best.rotation * grid.step_yaw_rad)};
  }

  bool scoresAll(const PoseGrid& grid) const {
    return config.estimate == PoseEstimate::kScoreGrid && ScoreGrid::poses(grid) <= kMostScores;
  }
  /// The points that decide which pose of the grid is best.
  struct SearchPoints {
    std::vector<Eigen::Vector2f> level_m;
    double share = 1.0;  ///< The points used, as a share of those spread over the scan.
  };
  SearchPoints searchPoints(const ProjectedScan& scan, const Pose2& guess, const SearchWindow& window,
                            const PoseGrid& grid) const;

  BestPose searchGrid(const std::vector<Eigen::Vector2f>& points, const PoseGrid& grid);
  void addSpreadElsewhere(const BestPose& best, double log_per_score, const Eigen::Vector3d& step,
                          const ExpectedPose& expected, Peak& peak) const;
  MatchResult resultOf(const SearchPoints& points, const PoseGrid& grid, const BestPose& best) const;
  MatchResult evaluate(const ProjectedScan& scan, const SearchPoints& points, const Pose2& guess,
                       const SearchWindow& window, const PoseGrid& grid, const BestPose& best, bool scored);
  double surfaceStep_rad(const std::vector<Eigen::Vector2f>& points) const;
  void distrustUnfaced(const SplitPoints& all_points, const std::vector<bool>& seen, const SplitPoints& surface_points,
                       const Pose2& finest, const ExpectedPose& expected, Peak& peak);
  std::vector<bool> supportedAt(const SplitPoints& points, const Pose2& pose);
  ScoreSurface surfaceAround(const SplitPoints& points, const Pose2& center, double step_rad);
  Eigen::Matrix3d attitudeCovariance(const SplitPoints& points, const Pose2& center, double step_rad, const Peak& peak);
  double profileVariance(const SplitPoints& points, const Pose2& center, const Eigen::Vector2d& axis);
  Eigen::Vector3d weightedMean(const SplitPoints& points, const PoseGrid& grid, const BestPose& best);
  void addWindows(const SplitPoints& points, const Pose2& center, double yaw_rad, int half, int rows,
                  std::vector<std::uint32_t>& sums);

  CorrelativeMatcherConfig config;
  Instructions instructions;
  LikelihoodField field;
  ReferenceView view;
  BranchAndBound search;
  ScoreGrid all_scores;  ///< Scores of the last match in which all poses were scored.
  std::vector<std::int32_t> x_cells, y_cells, offsets;
};

/// The points in the view of the reference. If too few are in it, all points but those on the backs of seen surfaces.
CorrelativeMatcher::Impl::SearchPoints CorrelativeMatcher::Impl::searchPoints(const ProjectedScan& scan,
                                                                              const Pose2& guess,
                                                                              const SearchWindow& window,
                                                                              const PoseGrid& grid) const {
  std::vector<Eigen::Vector2f> points =
      spreadPoints(scan.points_level_m, scoresAll(grid) ? config.surface_points : config.search_points, kMaxRange_m);
  const SplitPoints split(points);
  const double margin_m = std::clamp(window.half_translation_m, kViewMargin_m, 2.0 * kViewMargin_m);
  const std::vector<ReferenceView::Sight> sights = view.look(split.x_m, split.y_m, guess, margin_m);
  std::vector<Eigen::Vector2f> seen, possible;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sights[i] == ReferenceView::Sight::kSeen) seen.push_back(points[i]);
    if (sights[i] != ReferenceView::Sight::kBackOfSeen) possible.push_back(points[i]);
  }
  const double share = static_cast<double>(seen.size()) / std::max(1.0, static_cast<double>(possible.size()));
  if (share < kLeastInView || static_cast<int>(seen.size()) < kMinPoints) return {std::move(possible), 1.0};
  return {std::move(seen), share};
}

/// Computes sums[row * 16 + column]: the scores of the translations from -half on, in x and y, about `center` with its
/// rotation replaced by `yaw_rad`.
void CorrelativeMatcher::Impl::addWindows(const SplitPoints& points, const Pose2& center, double yaw_rad, int half,
                                          int rows, std::vector<std::uint32_t>& sums) {
  sums.assign(static_cast<std::size_t>(rows) * kWindowColumns, 0);
  std::vector<std::uint16_t> part(sums.size());
  BranchAndBound::cellsAt(field, points.x_m, points.y_m, yaw_rad, center.x_m - half * config.resolution_m,
                          center.y_m - half * config.resolution_m, rows + kWindowColumns, x_cells, y_cells);
  const LikelihoodField::Level level = field.level(0);
  offsets.resize(x_cells.size());
  for (std::size_t i = 0; i < offsets.size(); ++i) offsets[i] = y_cells[i] * level.stride + x_cells[i];
  for (std::size_t begin = 0; begin < offsets.size(); begin += kMaxWindowPoints) {
    const std::size_t count = std::min<std::size_t>(kMaxWindowPoints, offsets.size() - begin);
    sumWindows(instructions, level.cells, level.stride, std::span(offsets).subspan(begin, count), rows, part.data());
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += part[i];
  }
}

ScoreSurface CorrelativeMatcher::Impl::surfaceAround(const SplitPoints& points, const Pose2& center, double step_rad) {
  constexpr int kHalf = ScoreSurface::kHalf;
  ScoreSurface surface;
  surface.step_m = config.resolution_m;
  surface.step_rad = step_rad;
  std::vector<std::uint32_t> sums;
  for (int k = -kHalf; k <= kHalf; ++k) {
    addWindows(points, center, center.yaw_rad + k * step_rad, kHalf, ScoreSurface::kSize, sums);
    for (int y = -kHalf; y <= kHalf; ++y)
      for (int x = -kHalf; x <= kHalf; ++x) surface.at(x, y, k) = sums[windowIndex(x + kHalf, y + kHalf)];
  }
  return surface;
}

/// Marks the points that have support in the reference.
std::vector<bool> CorrelativeMatcher::Impl::supportedAt(const SplitPoints& points, const Pose2& pose) {
  BranchAndBound::allCellsAt(field, points.x_m, points.y_m, pose.yaw_rad, pose.x_m, pose.y_m, x_cells, y_cells);
  std::vector<bool> supported(x_cells.size());
  for (std::size_t i = 0; i < supported.size(); ++i) supported[i] = field.at(x_cells[i], y_cells[i]) > 0;
  return supported;
}

/// An attitude error moves each end point sideways by its height above the body times the error. The shift is common to
/// all points, so more points do not average it out. For an error about each axis, the shift of the peak is computed.
Eigen::Matrix3d CorrelativeMatcher::Impl::attitudeCovariance(const SplitPoints& points, const Pose2& center,
                                                             double step_rad, const Peak& peak) {
  // A smaller shift is below the least standard deviation of a match (quadratic_peak.cpp, kFloorSigma_m).
  constexpr float kLeastShift_m = 0.0005F;
  constexpr double kAttitudeError_deg = 1.0;  // Of roll and pitch; moves a point by its height over the body times it.
  const auto error_rad = static_cast<float>(kAttitudeError_deg * kRadPerDeg);
  float greatest_m = 0.0F;
  for (const float height : points.heights_m) greatest_m = std::max(greatest_m, std::abs(height));
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  if (greatest_m * error_rad < kLeastShift_m) return covariance;
  for (const bool about_x : {true, false}) {
    SplitPoints moved = points;
    std::vector<float>& coordinates = about_x ? moved.y_m : moved.x_m;
    for (std::size_t i = 0; i < coordinates.size(); ++i) coordinates[i] += error_rad * points.heights_m[i];
    const Eigen::Vector3d gradient = fitQuadratic(surfaceAround(moved, center, step_rad)).gradient;
    const Eigen::Vector3d shift = peak.peak_of_gradient * (gradient - peak.gradient);
    covariance += shift * shift.transpose();
  }
  return covariance;
}

Eigen::Vector3d CorrelativeMatcher::Impl::weightedMean(const SplitPoints& points, const PoseGrid& grid,
                                                       const BestPose& best) {
  constexpr int kHalf = ResolutionMean::kHalf, kRotations = ResolutionMean::kRotations;
  const Pose2 finest = poseAt(grid, best);
  ResolutionMean mean;
  for (int k = -kRotations; k <= kRotations; ++k)
    addWindows(points, finest, finest.yaw_rad + k * grid.step_yaw_rad, kHalf, 2 * kHalf + 1, mean.scores(k));
  return mean.of(best, config.levels, config.resolution_m)
      .cwiseProduct(Eigen::Vector3d(config.resolution_m, config.resolution_m, grid.step_yaw_rad));
}

BestPose CorrelativeMatcher::Impl::searchGrid(const std::vector<Eigen::Vector2f>& points, const PoseGrid& grid) {
  if (!scoresAll(grid)) return search.search(field, points, grid, penaltyFor(points.size()));
  const SplitPoints split(points);
  all_scores.score(field, split.x_m, split.y_m, grid);
  return all_scores.best(penaltyFor(points.size()));
}

/// Widens the covariance by the likely poses elsewhere in the window. If a direction becomes less certain than
/// `kSurfaceUnobservableSigma_m`, the pose keeps the guess along it.
void CorrelativeMatcher::Impl::addSpreadElsewhere(const BestPose& best, double log_per_score,
                                                  const Eigen::Vector3d& step, const ExpectedPose& expected,
                                                  Peak& peak) const {
  peak.covariance += step.asDiagonal() * all_scores.spreadElsewhere(best, log_per_score) * step.asDiagonal();
  if (peak.unobservable_motion) return;
  if (const auto spread = leastCertain(peak.covariance, step.x() / step.z(), kSurfaceUnobservableSigma_m))
    holdAlong(*spread, expected, peak);
}

/// Variance (m^2) about `center` of the positions along `axis` that score nearly as well. The likelihood is tempered,
/// so that a few points on moving or partly seen objects do not decide.
double CorrelativeMatcher::Impl::profileVariance(const SplitPoints& points, const Pose2& center,
                                                 const Eigen::Vector2d& axis) {
  const double step_m = 2.0 * config.resolution_m;
  const int half = static_cast<int>(config.profile_half_m / step_m);
  const LikelihoodField::Level level = field.level(0);
  std::vector<double> distances_m, qualities;
  for (int k = -half; k <= half; ++k) {
    const double distance_m = k * step_m;
    const Eigen::Vector2d at = center.position_m() + distance_m * axis;
    BranchAndBound::cellsAt(field, points.x_m, points.y_m, center.yaw_rad, at.x(), at.y(), 1, x_cells, y_cells);
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < x_cells.size(); ++i) sum += level.cells[y_cells[i] * level.stride + x_cells[i]];
    distances_m.push_back(distance_m);
    qualities.push_back(sum / (kTopValue * static_cast<double>(points.x_m.size())));
  }
  constexpr double kProfileTemperature = 0.010;  // Makes a pose e times less likely (docs/decisions/scan_matching.md).
  const double best = *std::max_element(qualities.begin(), qualities.end());
  double weights = 0.0, sum2 = 0.0;
  for (std::size_t i = 0; i < qualities.size(); ++i) {
    const double weight = std::exp((qualities[i] - best) / kProfileTemperature);
    weights += weight;
    sum2 += weight * distances_m[i] * distances_m[i];
  }
  return sum2 / weights;
}

/// The part of the result that does not depend on the shape of the scores.
MatchResult CorrelativeMatcher::Impl::resultOf(const SearchPoints& points, const PoseGrid& grid,
                                               const BestPose& best) const {
  MatchResult result;
  result.points_used = static_cast<int>(points.level_m.size());
  result.finest_score = best.score;
  result.finest_T_reference_body = result.T_reference_body = poseAt(grid, best);
  const int penalty =
      BranchAndBound::leastPenalty(penaltyFor(points.level_m.size()), grid, best.x, best.y, best.rotation, 0);
  result.quality = (best.score + penalty) / (kTopValue * static_cast<double>(points.level_m.size()));
  const auto atEdge = [](int i, int size) { return size > 1 && (i == 0 || i == size - 1); };
  result.at_window_edge =
      atEdge(best.x, grid.translations) || atEdge(best.y, grid.translations) || atEdge(best.rotation, grid.rotations);
  result.failed =
      result.quality * std::min(1.0, points.share / kUsuallyInView) < kMinQuality || result.points_used < kMinPoints;
  return result;
}

/// One rotation step moves the points by about one cell, so that the surface is about equally wide in all three
/// directions.
double CorrelativeMatcher::Impl::surfaceStep_rad(const std::vector<Eigen::Vector2f>& points) const {
  double lever2 = 0.0;
  for (const Eigen::Vector2f& p : points) lever2 += p.squaredNorm();
  const double lever_m = std::sqrt(lever2 / static_cast<double>(points.size()));
  return config.resolution_m / std::max(lever_m, 10.0 * config.resolution_m);
}

/// A contour that slides along itself, as a corridor along its axis or a round room about its middle, does not show
/// that motion. Along it the pose keeps the guess, or at least the covariance includes the spread of the positions that
/// score as well.
void CorrelativeMatcher::Impl::distrustUnfaced(const SplitPoints& all_points, const std::vector<bool>& seen,
                                               const SplitPoints& surface_points, const Pose2& finest,
                                               const ExpectedPose& expected, Peak& peak) {
  const double lever_m = leverOf_m(all_points.x_m, all_points.y_m);
  const Eigen::Matrix3d spread =
      motionSpread(all_points.x_m, all_points.y_m, lever_m, config.only_seen ? seen : std::vector<bool>{});
  if (const auto sliding = slidingMotion(spread, lever_m, config.min_normal_spread))
    holdAlong(common::turned(*sliding, finest.yaw_rad), expected, peak);
  const common::SymmetricEigen<2> normals = common::symmetricEigen(Eigen::Matrix2d(spread.topLeftCorner<2, 2>()));
  const Eigen::Vector2d axis = Eigen::Rotation2Dd(finest.yaw_rad) * normals.vectors.col(0);
  if (config.profile_half_m > 0.0 && normals.values(0) < kProfiledSpread)
    peak.covariance.topLeftCorner<2, 2>() += profileVariance(surface_points, finest, axis) * axis * axis.transpose();
}

MatchResult CorrelativeMatcher::Impl::evaluate(const ProjectedScan& scan, const SearchPoints& points,
                                               const Pose2& guess, const SearchWindow& window, const PoseGrid& grid,
                                               const BestPose& best, bool scored) {
  MatchResult result = resultOf(points, grid, best);
  const Pose2 finest = result.finest_T_reference_body;
  const SplitPoints spread_points = spreadWithHeights(scan, config.surface_points, kMaxRange_m);
  const std::vector<ReferenceView::Sight> sights = view.look(spread_points.x_m, spread_points.y_m, finest, 0.0);
  std::vector<bool> in_view, possible;
  for (const ReferenceView::Sight sight : sights) {
    possible.push_back(sight != ReferenceView::Sight::kBackOfSeen);
    if (possible.back()) in_view.push_back(sight == ReferenceView::Sight::kSeen);
  }
  const SplitPoints all_points = marked(spread_points, possible);
  field.prepare(0, 2 * kWindowColumns + 2 * ScoreSurface::kSize);
  const std::vector<bool> seen = supportedAt(all_points, finest);
  const auto supported = static_cast<double>(std::count(seen.begin(), seen.end(), true));
  result.overlap = supported / static_cast<double>(spread_points.x_m.size());
  if (config.only_seen) {
    const std::vector<bool> away = awayFromUnseen(all_points, seen, field.reach_m());
    std::transform(in_view.begin(), in_view.end(), away.begin(), in_view.begin(), std::logical_and<>());
  }
  const SplitPoints surface_points = mostOf(all_points, in_view);

  const double step_rad = scored ? grid.step_yaw_rad : surfaceStep_rad(points.level_m);
  ScoreSurface surface = scored ? all_scores.surfaceAround(best) : surfaceAround(surface_points, finest, step_rad);
  surface.step_m = config.resolution_m;
  surface.step_rad = step_rad;
  const ExpectedPose expected = expectedFrom(finest, guess, window);
  const double supported_there = std::min(supported, static_cast<double>(surface_points.x_m.size()));
  const SurfaceScale scale{scored ? supported : supported_there, field.reach_m(), kSurfaceCovarianceScale,
                           kSurfaceUnobservableSigma_m};
  Peak peak = findPeak(surface, scale, expected);
  peak.covariance += attitudeCovariance(surface_points, finest, step_rad, peak);
  if (config.estimate == PoseEstimate::kFinest) peak.offset.setZero();
  if (config.estimate == PoseEstimate::kWeightedMean) peak.offset = weightedMean(surface_points, grid, best);
  if (scored)
    addSpreadElsewhere(best, logPerScore(surface, scale), {surface.step_m, surface.step_m, step_rad}, expected, peak);
  distrustUnfaced(all_points, seen, surface_points, finest, expected, peak);

  result.covariance = peak.covariance;
  result.unobservable_motion = peak.unobservable_motion;
  result.T_reference_body = {finest.x_m + peak.offset.x(), finest.y_m + peak.offset.y(),
                             common::wrapAngle(finest.yaw_rad + peak.offset.z())};
  return result;
}

CorrelativeMatcher::CorrelativeMatcher(const CorrelativeMatcherConfig& config, Instructions instructions)
    : impl_(std::make_unique<Impl>(config, instructions)) {}
CorrelativeMatcher::~CorrelativeMatcher() = default;
CorrelativeMatcher::CorrelativeMatcher(CorrelativeMatcher&&) noexcept = default;
CorrelativeMatcher& CorrelativeMatcher::operator=(CorrelativeMatcher&&) noexcept = default;

void CorrelativeMatcher::clearReference() {
  impl_->field.clear();
  impl_->view.clear();
}

void CorrelativeMatcher::addReference(const ProjectedScan& scan, const Pose2& T_reference_body) {
  if (!isFinite(T_reference_body)) return;
  impl_->field.draw(contourOf(scan.points_level_m, kMaxGap_m, kMaxRange_m, T_reference_body));
  impl_->view.add(scan.points_level_m, T_reference_body);
}

MatchResult CorrelativeMatcher::match(const ProjectedScan& scan, const Pose2& guess, const SearchWindow& window) {
  if (!isFinite(guess) || impl_->field.empty()) return {};
  const PoseGrid grid = impl_->gridAround(guess, window);
  const Impl::SearchPoints points = impl_->searchPoints(scan, guess, window, grid);
  if (static_cast<int>(points.level_m.size()) < kMinPoints) return {};
  const BestPose best = impl_->searchGrid(points.level_m, grid);
  return impl_->evaluate(scan, points, guess, window, grid, best, impl_->scoresAll(grid));
}

MatchResult CorrelativeMatcher::matchExhaustively(const ProjectedScan& scan, const Pose2& guess,
                                                  const SearchWindow& window) {
  if (!isFinite(guess) || impl_->field.empty()) return {};
  const PoseGrid grid = impl_->gridAround(guess, window);
  const Impl::SearchPoints points = impl_->searchPoints(scan, guess, window, grid);
  if (static_cast<int>(points.level_m.size()) < kMinPoints) return {};
  const SplitPoints split(points.level_m);
  BestPose best;
  std::vector<std::int32_t> x_cells, y_cells;
  for (int k = 0; k < grid.rotations; ++k) {
    BranchAndBound::allCellsAt(impl_->field, split.x_m, split.y_m, grid.first_yaw_rad + k * grid.step_yaw_rad,
                               grid.first_x_m, grid.first_y_m, x_cells, y_cells);
    for (int y = 0; y < grid.translations; ++y) {
      for (int x = 0; x < grid.translations; ++x) {
        int score = -BranchAndBound::leastPenalty(impl_->penaltyFor(points.level_m.size()), grid, x, y, k, 0);
        for (std::size_t i = 0; i < points.level_m.size(); ++i)
          score += impl_->field.at(x_cells[i] + x, y_cells[i] + y);
        if (score > best.score) best = {score, x, y, k};
      }
    }
  }
  return impl_->evaluate(scan, points, guess, window, grid, best, false);
}

}  // namespace swiftlet::perception
