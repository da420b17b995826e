#include "perception/recognition/scan_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <Eigen/LU>

namespace swiftlet::perception {
namespace {

/// Two neighbouring returns farther apart than this, and than what a wall at a grazing angle explains, belong to two
/// surfaces.
constexpr double kGap_m = 0.3;
/// At an incidence of 80 degrees neighbouring returns are this many times farther apart than at a right angle.
constexpr double kGrazing = 6.0;
/// A point farther than so many sigmas from the chord splits a line; less would be noise (chi2 of one degree of freedom
/// at 99.7 %).
constexpr double kSplitSigmas = 3.0;
/// Two lines are one if their parameters differ by less than so much of their covariance: chi2 of two degrees of
/// freedom at 99 %.
constexpr double kMergeChi2 = 9.21;
/// Walls meet at an angle; between 30 and 150 degrees their intersection is well defined.
constexpr double kLeastCornerAngle_rad = std::numbers::pi / 6.0;
/// The ends of both walls must be this near to where they meet: beams at both sides of the corner are some centimetres
/// apart, and one may be mixed.
constexpr double kReach_m = 0.25;

/// Beams that are left out beside a corner.
constexpr std::size_t kTrimmed = 3;

struct Return {
  Eigen::Vector2d point_m;
  Eigen::Vector2d ray;
  double range_m;
};

using Returns = std::vector<Return>;

/// A run of returns that may be one line.
struct Run {
  std::size_t begin, end;  ///< Half open.
};

double wrapped(double angle_rad) { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

/// The weighted total least-squares line (K. Arras, R. Siegwart, "Feature extraction and scene interpretation for
/// map-based navigation", SPIE 1997) and its covariance: errors are along the beams, so a beam counts by how squarely
/// it meets the wall.
ScanLine fit(const Returns& returns, Run run, const ScanLineConfig& config) {
  double weights = 0.0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  const auto fitted = [&](const auto& weight_of) {
    weights = 0.0;
    mean.setZero();
    for (std::size_t i = run.begin; i < run.end; ++i) {
      weights += weight_of(returns[i]);
      mean += weight_of(returns[i]) * returns[i].point_m;
    }
    mean /= weights;
    spread.setZero();
    for (std::size_t i = run.begin; i < run.end; ++i) {
      const Eigen::Vector2d difference = returns[i].point_m - mean;
      spread += weight_of(returns[i]) * difference * difference.transpose();
    }
    // The normal is the direction of the least spread.
    return 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1)) + 0.5 * std::numbers::pi;
  };
  double angle = fitted([](const Return&) { return 1.0; });
  // The part of a range's error across the wall shrinks with the incidence, and the weight grows.
  const auto weight = [&](const Return& at) {
    const double across = std::max(0.2, std::abs(at.ray.dot(Eigen::Vector2d(std::cos(angle), std::sin(angle)))));
    return 1.0 / (across * across);
  };
  const double refined = fitted(weight);
  weights = 0.0;
  for (std::size_t i = run.begin; i < run.end; ++i) weights += weight(returns[i]);
  angle = refined;
  Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
  if (normal.dot(mean) < 0.0) {
    normal = -normal;
    angle += std::numbers::pi;
  }
  ScanLine line;
  line.angle_rad = wrapped(angle);
  line.distance_m = normal.dot(mean);
  line.beams = static_cast<int>(run.end - run.begin);
  const Eigen::Vector2d along(-normal.y(), normal.x());
  const auto foot = [&](const Return& at) -> Eigen::Vector2d {
    return line.distance_m * normal + along.dot(at.point_m) * along;
  };
  line.begin_m = foot(returns[run.begin]);
  line.end_m = foot(returns[run.end - 1]);
  // Regression of the distance on the place along the wall: its slope is the angle.
  const double lever = along.dot(mean), variance = config.range_sigma_m * config.range_sigma_m;
  const double angle_variance = variance / std::max(along.dot(spread * along), 1e-9);
  line.covariance << angle_variance, lever * angle_variance, lever * angle_variance,
      variance / weights + lever * lever * angle_variance;
  return line;
}

/// Splits at the point farthest from the chord as long as one is too far (Pavlidis and Horowitz; Nguyen et al., table
/// 1).
void split(const Returns& returns, Run run, const ScanLineConfig& config, std::vector<Run>& runs) {
  if (run.end - run.begin < static_cast<std::size_t>(config.beams_min)) return;
  const Eigen::Vector2d begin = returns[run.begin].point_m;
  const Eigen::Vector2d chord = (returns[run.end - 1].point_m - begin).normalized();
  double farthest_m = 0.0;
  std::size_t at = run.begin;
  for (std::size_t i = run.begin + 1; i + 1 < run.end; ++i) {
    const Eigen::Vector2d offset = returns[i].point_m - begin;
    const double distance_m = std::abs(chord.x() * offset.y() - chord.y() * offset.x());
    if (distance_m > farthest_m) {
      farthest_m = distance_m;
      at = i;
    }
  }
  // The chord goes through two noisy points, so that a point may be off by both errors.
  if (farthest_m <= std::sqrt(2.0) * kSplitSigmas * config.range_sigma_m) {
    runs.push_back(run);
    return;
  }
  split(returns, {run.begin, at + 1}, config, runs);
  split(returns, {at, run.end}, config, runs);
}

bool areOneLine(const ScanLine& a, const ScanLine& b) {
  // About the middle between them angle and distance are nearly independent.
  const Eigen::Vector2d middle = 0.5 * (a.end_m + b.begin_m);
  const double offset = (a.distance_m - a.normal().dot(middle)) - (b.distance_m - b.normal().dot(middle));
  const auto at_middle = [&](const ScanLine& line) -> Eigen::Matrix2d {
    const Eigen::Vector2d along(-line.normal().y(), line.normal().x());
    Eigen::Matrix2d shift;
    shift << 1.0, 0.0, -along.dot(middle), 1.0;
    return shift * line.covariance * shift.transpose();
  };
  const Eigen::Vector2d difference(wrapped(a.angle_rad - b.angle_rad), offset);
  const Eigen::Matrix2d covariance = at_middle(a) + at_middle(b);
  return difference.dot(covariance.inverse() * difference) < kMergeChi2;
}

Returns validReturns(const common::LaserScan& scan, std::vector<Run>& pieces) {
  Returns returns;
  std::size_t begin = 0;
  bool is_joined = false;
  const auto close = [&] {
    if (returns.size() > begin) pieces.push_back({begin, returns.size()});
    begin = returns.size();
  };
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (!(std::isfinite(range_m) && range_m >= scan.range_min_m && range_m <= scan.range_max_m)) {
      close();
      is_joined = false;
      continue;
    }
    const double angle = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    const Return next{range_m * ray, ray, range_m};
    const double spacing_m = std::abs(scan.angle_increment_rad) * range_m;
    if (is_joined && (next.point_m - returns.back().point_m).norm() > std::max(kGap_m, kGrazing * spacing_m)) close();
    returns.push_back(next);
    is_joined = true;
  }
  close();
  return returns;
}

}  // namespace

Eigen::Vector2d ScanLine::normal() const { return {std::cos(angle_rad), std::sin(angle_rad)}; }

std::vector<ScanLine> findLines(const common::LaserScan& scan, const ScanLineConfig& config) {
  std::vector<Run> pieces;
  const Returns returns = validReturns(scan, pieces);
  std::vector<ScanLine> lines;
  for (const Run& piece : pieces) {
    std::vector<Run> runs;
    split(returns, piece, config, runs);
    std::vector<Run> merged;
    for (const Run& run : runs) {
      if (!merged.empty() && merged.back().end + 1 >= run.begin &&
          areOneLine(fit(returns, merged.back(), config), fit(returns, run, config)))
        merged.back().end = run.end;
      else
        merged.push_back(run);
    }
    for (const Run& run : merged) {
      // At a corner the last beams may be on the other wall, or mixed from both.
      const Run inner{run.begin + (run.begin == piece.begin ? 0U : kTrimmed),
                      run.end - (run.end == piece.end ? 0U : kTrimmed)};
      if (run.end < run.begin + 2 * kTrimmed || inner.end < inner.begin + static_cast<std::size_t>(config.beams_min))
        continue;
      const ScanLine line = fit(returns, inner, config);
      if (line.length_m() >= config.length_min_m) lines.push_back(line);
    }
  }
  return lines;
}

std::vector<ScanCorner> findCorners(const std::vector<ScanLine>& lines, const ScanLineConfig&) {
  std::vector<ScanCorner> corners;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const ScanLine &a = lines[i], &b = lines[i + 1];
    const double sine = std::sin(b.angle_rad - a.angle_rad);
    if (std::abs(sine) < std::sin(kLeastCornerAngle_rad)) continue;
    Eigen::Matrix2d normals;
    normals << a.normal().transpose(), b.normal().transpose();
    const Eigen::Matrix2d inverse = normals.inverse();
    ScanCorner corner;
    corner.point_m = inverse * Eigen::Vector2d(a.distance_m, b.distance_m);
    if ((corner.point_m - a.end_m).norm() > kReach_m || (corner.point_m - b.begin_m).norm() > kReach_m) continue;
    // Normals point away from the laser, so that the space lies against both.
    corner.heading_rad = std::atan2(-a.normal().y() - b.normal().y(), -a.normal().x() - b.normal().x());
    const double between = std::acos(
        std::clamp((a.begin_m - corner.point_m).normalized().dot((b.end_m - corner.point_m).normalized()), -1.0, 1.0));
    const Eigen::Vector2d inwards(std::cos(corner.heading_rad), std::sin(corner.heading_rad));
    const bool is_convex = inwards.dot(a.begin_m + b.end_m - 2.0 * corner.point_m) < 0.0;
    corner.opening_rad = is_convex ? 2.0 * std::numbers::pi - between : between;
    // normal . point = distance: d point = inverse * (d distance - (d normal / d angle . point) d angle).
    const auto slide = [&](const ScanLine& line) {
      return -line.normal().y() * corner.point_m.x() + line.normal().x() * corner.point_m.y();
    };
    Eigen::Matrix<double, 3, 2> by_a, by_b;
    by_a.topRows<2>() = inverse.col(0) * Eigen::RowVector2d(-slide(a), 1.0);
    by_b.topRows<2>() = inverse.col(1) * Eigen::RowVector2d(-slide(b), 1.0);
    by_a.row(2) = by_b.row(2) = Eigen::RowVector2d(0.5, 0.0);
    corner.covariance = by_a * a.covariance * by_a.transpose() + by_b * b.covariance * by_b.transpose();
    corner.first_line = static_cast<int>(i);
    corners.push_back(corner);
  }
  return corners;
}

}  // namespace swiftlet::perception
