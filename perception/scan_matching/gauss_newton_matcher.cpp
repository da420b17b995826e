#include "perception/scan_matching/gauss_newton_matcher.hpp"

#include <cmath>
#include <vector>

#include "perception/scan_matching/interpolated_field.hpp"
#include "perception/scan_matching/least_squares_match.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

/// Side of a cell of the finest map; kSupport_m is two to seven times this.
constexpr double kResolution_m = 0.01;
/// Maps, each four times as coarse as the one before, as is the support of a point in it.
constexpr int kLevels = 3;
/// Greatest number of steps at each level but the finest.
constexpr int kLevelIterations = 4;
/// Greatest number of steps at the finest level.
constexpr int kFinestIterations = 8;

/// Resolution of a level relative to the next finer one. Hector SLAM (Kohlbrecher 2011, section IV-C) halves it; a
/// ratio of four needs half the levels.
constexpr int kLevelRatio = 4;
/// Coarse levels only need an approximate pose, so they use every fourth point.
constexpr std::size_t kCoarseStride = 4;
/// A step smaller than this share of a cell ends a level.
constexpr double kSmallStep_cells = 0.05;
/// A last step larger than this share of a cell means that the search did not converge.
constexpr double kConverged_cells = 0.5;
/// A step that lowers the score is halved at most this often. If an eighth of it lowers the score too, the level ends.
constexpr int kHalvings = 3;

}  // namespace

struct GaussNewtonMatcher::Impl {
  Impl() {
    double scale = 1.0;
    for (int k = 0; k < kLevels; ++k, scale *= kLevelRatio)
      fields.emplace_back(scale * kResolution_m, scale * LeastSquaresMatch::kSupport_m / 3.0);
  }

  std::size_t coarsestNeeded(const LeastSquaresMatch& match) const;
  double climb(const LeastSquaresMatch& match, std::size_t level, Pose2& pose) const;
  MatchResult descend(const LeastSquaresMatch& match, Pose2 pose) const;

  std::vector<LikelihoodField> fields;  ///< Finest level first.
};

namespace {

struct Linearized {
  NormalEquations equations;
  double quality_sum = 0.0;
};

Pose2 halfway(const Pose2& a, const Pose2& b) {
  return {0.5 * (a.x_m + b.x_m), 0.5 * (a.y_m + b.y_m),
          common::wrapAngle(a.yaw_rad + 0.5 * common::wrapAngle(b.yaw_rad - a.yaw_rad))};
}

enum class Purpose { kStep, kVerdict };

/// Linearizes at a pose. Coarse levels use every `stride`th point.
Linearized linearize(Purpose purpose, const LeastSquaresMatch& match, const LikelihoodField& field, const Pose2& pose,
                     std::size_t stride = 1) {
  const double cosine = std::cos(pose.yaw_rad), sine = std::sin(pose.yaw_rad);
  const double reach2 = field.reach_m() * field.reach_m(), inverse_lever = match.inverseLever();
  const auto turned = [&](const Eigen::Vector2f& v) {
    const double x = static_cast<double>(v.x()), y = static_cast<double>(v.y());
    return Eigen::Vector2d(cosine * x - sine * y, sine * x + cosine * y);
  };
  NormalEquations equations;
  double quality_sum = 0.0;
  for (std::size_t i = 0; i < match.points().size(); i += stride) {
    const OrientedPoint& p = match.points()[i];
    const Eigen::Vector2d arm_m = turned(p.point_m), normal = turned(p.normal);
    const std::optional<FieldSample> sample = sampleField(field, arm_m + pose.position_m());
    if (!sample) continue;
    // 1 - value is (d / reach)^2. Half its slope times reach^2 is the vector from the contour to the point.
    equations.add(arm_m, normal, -0.5 * reach2 * sample->slope_1_m, inverse_lever);
    quality_sum += sample->value;
    if (purpose == Purpose::kVerdict) equations.addTilt(arm_m, normal, static_cast<double>(p.height_m), inverse_lever);
  }
  // Computed from the values: between cells, the slope near a contour is smaller than the distance implies.
  equations.squares_m2 = reach2 * (equations.count - quality_sum);
  return {equations, quality_sum};
}

}  // namespace

/// The finest level whose support covers the search window, or the coarsest level if none does.
std::size_t GaussNewtonMatcher::Impl::coarsestNeeded(const LeastSquaresMatch& match) const {
  std::size_t level = 0;
  while (level + 1 < fields.size() && fields[level].reach_m() < match.windowReach_m()) ++level;
  return level;
}

/// Iterates on one level and returns the length of the last step tried. Between cells the slope is rough: a step that
/// lowers the score is halved a few times, so that the iteration does not oscillate.
double GaussNewtonMatcher::Impl::climb(const LeastSquaresMatch& match, std::size_t level, Pose2& pose) const {
  const LikelihoodField& field = fields[level];
  const std::size_t stride = level == 0 ? 1 : kCoarseStride;
  const int most = level == 0 ? kFinestIterations : kLevelIterations;
  Linearized here = linearize(Purpose::kStep, match, field, pose, stride);
  double moved_m = 0.0;
  for (int i = 0; i < most; ++i) {
    Pose2 next = pose;
    moved_m = match.step(here.equations, field.reach_m(), next);
    Linearized there = linearize(Purpose::kStep, match, field, next, stride);
    for (int halving = 0; halving < kHalvings && there.quality_sum < here.quality_sum; ++halving) {
      next = halfway(pose, next);
      moved_m *= 0.5;
      there = linearize(Purpose::kStep, match, field, next, stride);
    }
    if (there.quality_sum < here.quality_sum) break;
    pose = next;
    here = there;
    if (!(moved_m > kSmallStep_cells * field.resolution_m())) break;
  }
  return moved_m;
}

MatchResult GaussNewtonMatcher::Impl::descend(const LeastSquaresMatch& match, Pose2 pose) const {
  double moved_m = 0.0;
  for (std::size_t level = coarsestNeeded(match) + 1; level-- > 0;) moved_m = climb(match, level, pose);
  const Linearized at_end = linearize(Purpose::kVerdict, match, fields.front(), pose);
  return match.finish(at_end.equations, at_end.quality_sum, moved_m < kConverged_cells * kResolution_m, pose);
}

GaussNewtonMatcher::GaussNewtonMatcher() : impl_(std::make_unique<Impl>()) {}
GaussNewtonMatcher::~GaussNewtonMatcher() = default;
GaussNewtonMatcher::GaussNewtonMatcher(GaussNewtonMatcher&&) noexcept = default;
GaussNewtonMatcher& GaussNewtonMatcher::operator=(GaussNewtonMatcher&&) noexcept = default;

void GaussNewtonMatcher::clearReference() {
  for (LikelihoodField& field : impl_->fields) field.clear();
}

void GaussNewtonMatcher::addReference(const ProjectedScan& scan, const Pose2& T_reference_body) {
  if (!isFinite(T_reference_body)) return;
  addReference(contourOf(scan.points_level_m, LeastSquaresMatch::kMaxGap_m, kMaxRange_m, T_reference_body));
}

void GaussNewtonMatcher::addReference(std::span<const ContourSegment> contour_reference_m) {
  for (LikelihoodField& field : impl_->fields) field.draw(contour_reference_m);
}

MatchResult GaussNewtonMatcher::match(const ProjectedScan& scan, const Pose2& guess, const SearchWindow& window) {
  if (!isFinite(guess) || impl_->fields.front().empty()) return {};
  const LeastSquaresMatch match(scan, guess, window);
  if (!match.hasEnoughPoints()) return {};
  return impl_->descend(match, guess);
}

}  // namespace swiftlet::perception
