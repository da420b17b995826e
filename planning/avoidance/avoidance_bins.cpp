// Beams to bins.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "common/config_fields.hpp"
#include "planning/avoidance/avoidance.hpp"

namespace swiftlet::planning {
namespace {

using Point = Eigen::Vector2d;

/// Returns nearer to the origin than this are the vehicle itself.
constexpr double kSelfRadius_m = 0.10;
/// Beams of the sliding mean (Saeedi, section III-G).
constexpr int kSmoothingWindow = 5;

std::vector<Point> slidingMean(const std::vector<Point>& points) {
  std::vector<Point> result;
  const int half = kSmoothingWindow / 2, count = static_cast<int>(points.size());
  for (int i = 0; i < count; ++i) {
    double sum = 0.0;
    int used = 0;
    for (int j = std::max(0, i - half); j <= std::min(count - 1, i + half); ++j, ++used)
      sum += points[static_cast<std::size_t>(j)].norm();
    const Point& p = points[static_cast<std::size_t>(i)];
    result.push_back(p * (sum / used / p.norm()));
  }
  return result;
}

std::vector<Point> medianOfThree(const std::vector<Point>& points) {
  if (points.size() < 3) return points;
  std::vector<Point> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    // At the ends of the scan the third beam is the next one inwards.
    const std::size_t first = std::clamp<std::size_t>(i, 1, points.size() - 2) - 1;
    std::array<double, 3> ranges{points[first].norm(), points[first + 1].norm(), points[first + 2].norm()};
    std::sort(ranges.begin(), ranges.end());
    result.push_back(points[i] * (ranges[1] / points[i].norm()));
  }
  return result;
}

/// The sector that a point lies in; none outside the field of view.
std::optional<std::size_t> sectorOf(const AvoidanceConfig& config, const Point& p) {
  const double view_rad = config.field_of_view_deg * std::numbers::pi / 180.0, width_rad = view_rad / config.bins;
  const auto slot = static_cast<int>(std::floor((std::atan2(p.y(), p.x()) + 0.5 * view_rad) / width_rad));
  return slot < 0 || slot >= config.bins ? std::nullopt : std::optional(static_cast<std::size_t>(slot));
}

/// The point shortens the sector if it is the nearest.
void take(Bin& bin, const Point& p) {
  const double range_m = p.norm();
  if (range_m >= bin.range_m) return;
  bin.range_m = range_m;
  bin.nearest_level_m = p;
}

}  // namespace

std::vector<Point> Avoidance::smoothed(const Config& config, std::span<const Eigen::Vector2f> points_level_m) {
  std::vector<Point> points;
  points.reserve(points_level_m.size());
  for (const Eigen::Vector2f& p : points_level_m)
    if (p.allFinite() && p.norm() > kSelfRadius_m) points.push_back(p.cast<double>());
  return config.bin_range == BinRange::kMean ? slidingMean(points) : medianOfThree(points);
}

std::vector<Bin> Avoidance::bins(const Config& config, const std::vector<Point>& smoothed_level_m) {
  const double view_rad = config.field_of_view_deg * std::numbers::pi / 180.0, width_rad = view_rad / config.bins;
  std::vector<Bin> bins(static_cast<std::size_t>(config.bins));
  std::vector<double> sums(bins.size(), 0.0);
  std::vector<int> counts(bins.size(), 0);
  for (std::size_t i = 0; i < bins.size(); ++i)
    bins[i] = {-0.5 * view_rad + (static_cast<double>(i) + 0.5) * width_rad, std::numeric_limits<double>::infinity(),
               Point::Zero()};
  for (const Point& p : smoothed_level_m) {
    const auto sector = sectorOf(config, p);
    if (!sector) continue;
    sums[*sector] += p.norm();
    ++counts[*sector];
    take(bins[*sector], p);
  }
  if (config.bin_range == BinRange::kMean) {
    for (std::size_t i = 0; i < bins.size(); ++i) {
      if (counts[i] == 0) continue;
      bins[i].range_m = sums[i] / counts[i];
      bins[i].nearest_level_m = bins[i].range_m * Point(std::cos(bins[i].bearing_rad), std::sin(bins[i].bearing_rad));
    }
  }
  return bins;
}

void Avoidance::shorten(const Config& config, std::span<const Eigen::Vector2f> points_level_m, std::vector<Bin>& bins) {
  for (const Eigen::Vector2f& p : points_level_m)
    if (const auto sector = sectorOf(config, p.cast<double>())) take(bins[*sector], p.cast<double>());
}

}  // namespace swiftlet::planning
