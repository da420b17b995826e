#include "perception/scan_matching/scan_contour.hpp"

#include <algorithm>
#include <cmath>

#include "common/small_matrices.hpp"

namespace swiftlet::perception {
namespace {

/// A step along a surface may be this many times as long as its neighbours, plus kGapNoise_m for noise.
constexpr float kMaxStretch = 2.5F;
constexpr float kGapNoise_m = 0.05F;  ///< The accuracy of a UTM-30LX beyond 10 m.
/// Longer gaps are bridged only along a straight line, as for a distant wall at a grazing angle that is seen as
/// separate dots. Dots would match the dots of the next scan wherever the vehicle moved along the wall.
constexpr float kShortGap_m = 0.3F;
constexpr float kStraight_cos = 0.966F;  // 15 degrees.
/// A jump between surfaces counts as this length of contour, so that lone points are still chosen.
constexpr float kLeap_m = 0.3F;
/// Neighbours on either side over which the spacing of points is averaged.
constexpr int kSmoothedOver = 4;

std::vector<Eigen::Vector2f> usable(std::span<const Eigen::Vector2f> points_m, double max_range_m) {
  const auto max2 = static_cast<float>(max_range_m * max_range_m);
  std::vector<Eigen::Vector2f> result;
  result.reserve(points_m.size());
  for (const Eigen::Vector2f& p : points_m)
    if (p.squaredNorm() <= max2) result.push_back(p);  // Drops NaN.
  return result;
}

/// Whether the step from point i to the next has the direction of the steps before and after it.
bool isStraight(std::span<const Eigen::Vector2f> points, std::size_t i) {
  if (i == 0 || i + 2 >= points.size()) return false;
  const Eigen::Vector2f before = points[i] - points[i - 1], step = points[i + 1] - points[i],
                        after = points[i + 2] - points[i + 1];
  return before.dot(step) > kStraight_cos * before.norm() * step.norm() &&
         after.dot(step) > kStraight_cos * after.norm() * step.norm();
}

}  // namespace

std::vector<bool> joinsOf(std::span<const Eigen::Vector2f> points, double max_gap_m) {
  std::vector<bool> joins(points.size(), false);
  if (points.size() < 2) return joins;
  const std::size_t gaps = points.size() - 1;
  std::vector<float> gap(gaps);
  for (std::size_t i = 0; i < gaps; ++i) gap[i] = (points[i + 1] - points[i]).norm();
  for (std::size_t i = 0; i < gaps; ++i) {
    if (gap[i] >= static_cast<float>(max_gap_m)) continue;
    const float before = i > 0 ? gap[i - 1] : gap[i];
    const float after = i + 1 < gaps ? gap[i + 1] : gap[i];
    joins[i] = gap[i] <= kMaxStretch * std::min(before, after) + kGapNoise_m &&
               (gap[i] <= kShortGap_m || isStraight(points, i));
  }
  return joins;
}

std::vector<ContourSegment> contourOf(std::span<const Eigen::Vector2f> points_m, double max_gap_m, double max_range_m) {
  const std::vector<Eigen::Vector2f> points = usable(points_m, max_range_m);
  const std::vector<bool> joins = joinsOf(points, max_gap_m);
  std::vector<ContourSegment> segments;
  segments.reserve(points.size());
  bool joined_before = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (joins[i])
      segments.push_back({points[i].cast<double>(), points[i + 1].cast<double>()});
    else if (!joined_before)
      segments.push_back({points[i].cast<double>(), points[i].cast<double>()});
    joined_before = joins[i];
  }
  return segments;
}

std::vector<ContourSegment> contourOf(std::span<const Eigen::Vector2f> points_m, double max_gap_m, double max_range_m,
                                      const common::Pose2& T_reference_body) {
  std::vector<ContourSegment> contour = contourOf(points_m, max_gap_m, max_range_m);
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(T_reference_body.yaw_rad).toRotationMatrix();
  for (ContourSegment& segment : contour) {
    segment.begin_m = R * segment.begin_m + T_reference_body.position_m();
    segment.end_m = R * segment.end_m + T_reference_body.position_m();
  }
  return contour;
}

std::vector<int> spreadIndices(std::span<const Eigen::Vector2f> points_m, int count, double max_range_m) {
  const auto max2 = static_cast<float>(max_range_m * max_range_m);
  std::vector<int> usable_points;
  std::vector<Eigen::Vector2f> unrolled;  // The points with the jumps between them shortened.
  usable_points.reserve(points_m.size());
  unrolled.reserve(points_m.size());
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    if (!(points_m[i].squaredNorm() <= max2)) continue;  // Also skips NaN.
    Eigen::Vector2f step(0.0F, 0.0F);
    if (!usable_points.empty()) step = points_m[i] - points_m[static_cast<std::size_t>(usable_points.back())];
    const float leap2 = step.squaredNorm();
    if (leap2 > kLeap_m * kLeap_m) step *= kLeap_m / std::sqrt(leap2);
    unrolled.push_back(unrolled.empty() ? step : unrolled.back() + step);
    usable_points.push_back(static_cast<int>(i));
  }
  if (usable_points.size() <= static_cast<std::size_t>(count)) return usable_points;

  // The spacing is averaged over several neighbours. Otherwise a point displaced by noise would be chosen more often,
  // and the noise of the chosen points would not average out.
  const int size = static_cast<int>(unrolled.size());
  std::vector<float> step(unrolled.size());
  float length = 0.0F;
  for (int i = 0; i < size; ++i) {
    const int begin = std::max(i - kSmoothedOver, 0), end = std::min(i + kSmoothedOver, size - 1);
    step[static_cast<std::size_t>(i)] =
        (unrolled[static_cast<std::size_t>(end)] - unrolled[static_cast<std::size_t>(begin)]).norm() /
        static_cast<float>(end - begin);
    length += step[static_cast<std::size_t>(i)];
  }
  const float spacing = length / static_cast<float>(count);
  std::vector<int> chosen;
  chosen.reserve(static_cast<std::size_t>(count));
  float along = 0.5F * spacing;
  for (std::size_t i = 0; i < usable_points.size() && chosen.size() < static_cast<std::size_t>(count); ++i) {
    along += step[i];
    if (along < spacing) continue;
    // In this case the difference is exact, and it saves a division.
    along = along < 2.0F * spacing ? along - spacing : std::fmod(along, spacing);
    chosen.push_back(usable_points[i]);
  }
  return chosen;
}

std::vector<Eigen::Vector2f> spreadPoints(std::span<const Eigen::Vector2f> points_m, int count, double max_range_m) {
  std::vector<Eigen::Vector2f> chosen;
  for (const int i : spreadIndices(points_m, count, max_range_m))
    chosen.push_back(points_m[static_cast<std::size_t>(i)]);
  return chosen;
}

double leverOf_m(std::span<const float> x_m, std::span<const float> y_m) {
  constexpr double kLeast_m = 0.1;
  double sum2 = 0.0;
  for (std::size_t i = 0; i < x_m.size(); ++i)
    sum2 += static_cast<double>(x_m[i]) * x_m[i] + static_cast<double>(y_m[i]) * y_m[i];
  return std::max(kLeast_m, std::sqrt(sum2 / std::max<double>(1.0, static_cast<double>(x_m.size()))));
}

Eigen::Matrix3d motionSpread(std::span<const float> x_m, std::span<const float> y_m, double lever_m,
                             const std::vector<bool>& counted) {
  // A normal is that of two points between 0.2 m and 2 m apart: over less, range noise of 1 cm turns it by more than 4
  // degrees; over more, the points may be on different walls.
  constexpr float kBaseline2_m2 = 0.04F;
  constexpr float kLongest2_m2 = 4.0F;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double count = 0.0;
  std::size_t begin = 0;
  for (std::size_t end = 1; end < x_m.size(); ++end) {
    const auto step2 = [&](std::size_t from) {
      const float dx = x_m[end] - x_m[from], dy = y_m[end] - y_m[from];
      return dx * dx + dy * dy;
    };
    while (begin + 1 < end && step2(begin + 1) >= kBaseline2_m2) ++begin;
    const float length2 = step2(begin);
    if (length2 < kBaseline2_m2 || length2 > kLongest2_m2) continue;
    if (!counted.empty() && (!counted[begin] || !counted[end])) continue;
    const Eigen::Vector2d normal(y_m[begin] - y_m[end], x_m[end] - x_m[begin]);
    const Eigen::Vector2d middle(0.5 * (x_m[begin] + x_m[end]), 0.5 * (y_m[begin] + y_m[end]));
    const Eigen::Vector3d moved(normal.x(), normal.y(), (middle.x() * normal.y() - middle.y() * normal.x()) / lever_m);
    sum += moved * moved.transpose() / static_cast<double>(length2);
    count += 1.0;
  }
  return count > 0.0 ? Eigen::Matrix3d(sum / count) : Eigen::Matrix3d::Zero();
}

std::optional<common::UnobservableMotion> slidingMotion(const Eigen::Matrix3d& spread, double lever_m,
                                                        double least_share) {
  // About a point so many levers away that the noise of the normals cannot tell it from one at infinity: the walls are
  // straight, and a vehicle that flies along them keeps its direction.
  constexpr double kFarMiddle = 12.0;
  const common::SymmetricEigen<3> motions = common::symmetricEigen(spread);
  if (!(motions.values(0) < least_share)) return std::nullopt;
  Eigen::Vector3d least = motions.vectors.col(0);
  if (least.head<2>().norm() > kFarMiddle * std::abs(least.z())) least.z() = 0.0;
  return common::UnobservableMotion{least.cwiseQuotient(Eigen::Vector3d(1.0, 1.0, lever_m)), lever_m};
}

}  // namespace swiftlet::perception
