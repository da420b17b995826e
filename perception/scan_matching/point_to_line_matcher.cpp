#include "perception/scan_matching/point_to_line_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/normal_distribution.hpp"
#include "perception/scan_matching/least_squares_match.hpp"
#include "perception/scan_matching/oriented_points.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

/// Points are paired no farther than this, and less far when the window is small.
constexpr double kMaxDistance_m = 0.5;
/// Pairs with more than this many times the usual distance are left out.
constexpr double kTrimSigmas = 3.0;
/// Greatest number of times that pairs are made.
constexpr int kIterations = 20;

/// A step smaller than this ends the search. If the last step is larger than `kConverged_m`, it did not converge.
constexpr double kSmallStep_m = 0.0002;
constexpr double kConverged_m = 0.005;
/// The pairing distance shrinks at most by this factor per iteration. Where most walls fit already, those that face
/// another direction are still far off; a faster shrinking would reject them as outliers before they correct the pose.
constexpr double kSlowest = 0.6;

/// A point of the scan and the line it is paired with, at one pose.
struct Pair {
  Eigen::Vector2d arm_m, normal;
  double distance_m = 0.0;
  double height_m = 0.0;
};

}  // namespace

struct PointToLineMatcher::Impl {
  void makePairs(const LeastSquaresMatch& match, const Pose2& pose, double radius_m);
  double trimAt();
  MatchResult verdict(const LeastSquaresMatch& match, const Pose2& pose, double moved_m);

  OrientedPoints reference;
  std::vector<Pair> pairs;
  std::vector<double> distances;
};

void PointToLineMatcher::Impl::makePairs(const LeastSquaresMatch& match, const Pose2& pose, double radius_m) {
  const double cosine = std::cos(pose.yaw_rad), sine = std::sin(pose.yaw_rad);
  const auto turned = [&](const Eigen::Vector2f& v) {
    const double x = static_cast<double>(v.x()), y = static_cast<double>(v.y());
    return Eigen::Vector2d(cosine * x - sine * y, sine * x + cosine * y);
  };
  pairs.clear();
  for (const OrientedPoint& p : match.points()) {
    const Eigen::Vector2d arm_m = turned(p.point_m), at_m = arm_m + pose.position_m();
    const int nearest = reference.nearest(at_m, turned(p.normal), radius_m);
    if (nearest == OrientedPoints::kNone) continue;
    const Eigen::Vector2d& normal = reference.normal(nearest);
    pairs.push_back({arm_m, normal, normal.dot(at_m - reference.point_m(nearest)), static_cast<double>(p.height_m)});
  }
}

/// The distance beyond which a pair is an outlier: `kTrimSigmas` standard deviations, estimated from the median.
double PointToLineMatcher::Impl::trimAt() {
  if (pairs.empty()) return 0.0;
  distances.clear();
  for (const Pair& pair : pairs) distances.push_back(std::abs(pair.distance_m));
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return kTrimSigmas * common::kSigmaOfMedian * *middle;
}

MatchResult PointToLineMatcher::Impl::verdict(const LeastSquaresMatch& match, const Pose2& pose, double moved_m) {
  makePairs(match, pose, LeastSquaresMatch::kSupport_m);
  const double trim_m = trimAt();
  NormalEquations equations;
  double quality_sum = 0.0, supported = 0.0;
  for (const Pair& pair : pairs) {
    const double share = pair.distance_m / LeastSquaresMatch::kSupport_m;
    quality_sum += 1.0 - share * share;
    supported += 1.0;
    if (std::abs(pair.distance_m) > trim_m) continue;
    equations.add(pair.arm_m, pair.normal, pair.distance_m * pair.normal, match.inverseLever());
    equations.addTilt(pair.arm_m, pair.normal, pair.height_m, match.inverseLever());
  }
  MatchResult result = match.finish(equations, quality_sum, moved_m < kConverged_m, pose);
  result.overlap = supported / static_cast<double>(match.points().size());
  return result;
}

PointToLineMatcher::PointToLineMatcher() : impl_(std::make_unique<Impl>()) {}
PointToLineMatcher::~PointToLineMatcher() = default;
PointToLineMatcher::PointToLineMatcher(PointToLineMatcher&&) noexcept = default;
PointToLineMatcher& PointToLineMatcher::operator=(PointToLineMatcher&&) noexcept = default;

void PointToLineMatcher::clearReference() { impl_->reference.clear(); }

void PointToLineMatcher::addReference(const ProjectedScan& scan, const Pose2& T_reference_body) {
  if (!isFinite(T_reference_body)) return;
  impl_->reference.add(orientedPoints(scan, 0, LeastSquaresMatch::kMaxGap_m, kMaxRange_m), T_reference_body,
                       LeastSquaresMatch::kMaxGap_m);
}

MatchResult PointToLineMatcher::match(const ProjectedScan& scan, const Pose2& guess, const SearchWindow& window) {
  Impl& self = *impl_;
  if (!isFinite(guess) || self.reference.empty()) return {};
  const LeastSquaresMatch match(scan, guess, window);
  if (!match.hasEnoughPoints()) return {};
  self.reference.sort();

  Pose2 pose = guess;
  double reach_m = std::clamp(match.windowReach_m(), LeastSquaresMatch::kSupport_m, kMaxDistance_m), moved_m = INFINITY;
  for (int i = 0; i < kIterations && (moved_m > kSmallStep_m || reach_m > LeastSquaresMatch::kSupport_m); ++i) {
    self.makePairs(match, pose, reach_m);
    reach_m = std::clamp(self.trimAt(), std::max(LeastSquaresMatch::kSupport_m, kSlowest * reach_m), reach_m);
    NormalEquations equations;
    for (const Pair& pair : self.pairs)
      if (std::abs(pair.distance_m) <= reach_m)
        equations.add(pair.arm_m, pair.normal, pair.distance_m * pair.normal, match.inverseLever());
    moved_m = match.step(equations, reach_m, pose);
  }
  return self.verdict(match, pose, moved_m);
}

}  // namespace swiftlet::perception
