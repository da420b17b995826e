// Beams to bins, and the configuration of the reactive layer.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "planning/avoidance/avoidance.hpp"

namespace swiftlet::planning {
namespace {

using Point = Eigen::Vector2d;

std::vector<Point> slidingMean(const std::vector<Point>& points, int window) {
  std::vector<Point> result;
  const int half = window / 2, count = static_cast<int>(points.size());
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

}  // namespace

void Avoidance::Config::describe(common::config::Fields& fields) {
  fields("bins", bins, {4, 1000}, "Sectors into which the field of view is divided.");
  fields("field_of_view_deg", field_of_view_deg, {10, 360},
         "Angle centred on the nose in which the layer counts on the laser.");
  fields.choice("bin_range", bin_range, {"mean", "robust_minimum"}, "Range that stands for the beams of a bin.");
  fields("smoothing_window", smoothing_window, {1, 101}, "Beams of the sliding mean that `mean` smooths with.");
  fields("max_speed_m_s", max_speed_m_s, {0.05, 20}, "Speed limit where nothing is near.");
  fields("deceleration_m_s2", deceleration_m_s2, {0.1, 20}, "Braking that can be counted on.");
  fields("blind_speed_m_s", blind_speed_m_s, {0.05, 20}, "Speed limit on a course that the laser does not see.");
  fields("latency_s", latency_s, {0, 2}, "Time from a return to its first effect on the speed.");
  fields("margin_m", margin_m, {0, 2}, "Distance between hull and obstacle when the vehicle has stopped.");
  fields("retreat_distance_m", retreat_distance_m, {0, 5},
         "Something unmapped nearer to the hull than this makes the vehicle retreat.");
  fields("contact_time_s", contact_time_s, {0, 10},
         "Something moving that would arrive within this time makes the vehicle retreat.");
  fields("contact_gap_m", contact_gap_m, {0, 5}, "Passing nearer than this to the hull counts as arriving.");
  fields("closing_speed_m_s", closing_speed_m_s, {0.01, 5},
         "What closes in more slowly than this does not count as moving.");
  fields("mapped_within_m", mapped_within_m, {0, 1},
         "A return this near to something mapped or unknown is not unmapped.");
  fields("retreat_speed_m_s", retreat_speed_m_s, {0.05, 10}, "Greatest speed of a retreat.");
  fields("retreat_margin_m", retreat_margin_m, {0, 2}, "Distance between hull and obstacle when a retreat has ended.");
  fields("view_margin_deg", view_margin_deg, {0, 180},
         "While retreating the vehicle turns until the danger and its course are this far within the field of view.");
  fields("release_factor", release_factor, {1, 5},
         "Factor on distances and times while retreating, so that a retreat does not flicker.");
  fields("calm_s", calm_s, {0, 10}, "A retreat ends this long after the danger.");
  fields("self_radius_m", self_radius_m, {0, 1}, "Returns nearer to the origin than this are the vehicle itself.");
}

std::vector<std::string> Avoidance::Config::validateAgainst(double clearance_m, double keep_out_m) const {
  std::vector<std::string> problems;
  if (margin_m >= clearance_m)
    problems.push_back(
        fmt::format("margin_m: {:.2f} m forbids the clearance of {:.2f} m that the planner may use; it must be smaller",
                    margin_m, clearance_m));
  if (retreat_distance_m * release_factor > clearance_m + keep_out_m)
    problems.push_back(
        fmt::format("retreat_distance_m: {:.2f} m (times {:.2f} to be released) forbids passing unmapped things at "
                    "{:.2f} m, as the "
                    "planner may; it must be smaller",
                    retreat_distance_m, release_factor, clearance_m + keep_out_m));
  return problems;
}

std::vector<Point> Avoidance::smoothed(const Config& config, std::span<const Eigen::Vector2f> points_level_m) {
  std::vector<Point> points;
  points.reserve(points_level_m.size());
  for (const Eigen::Vector2f& p : points_level_m)
    if (p.allFinite() && p.norm() > std::max(config.self_radius_m, 1e-3)) points.push_back(p.cast<double>());
  return config.bin_range == BinRange::kMean ? slidingMean(points, config.smoothing_window) : medianOfThree(points);
}

std::vector<Bin> Avoidance::bins(const Config& config, const std::vector<Point>& smoothed_level_m) {
  const double view_rad = config.field_of_view_deg * std::numbers::pi / 180.0, width_rad = view_rad / config.bins;
  std::vector<Bin> bins(static_cast<std::size_t>(config.bins));
  std::vector<double> sums(bins.size(), 0.0);
  std::vector<int> counts(bins.size(), 0);
  for (std::size_t i = 0; i < bins.size(); ++i)
    bins[i] = {
        -0.5 * view_rad + (static_cast<double>(i) + 0.5) * width_rad, std::numeric_limits<double>::infinity(), {}};
  for (const Point& p : smoothed_level_m) {
    const auto slot = static_cast<int>(std::floor((std::atan2(p.y(), p.x()) + 0.5 * view_rad) / width_rad));
    if (slot < 0 || slot >= config.bins) continue;
    const auto i = static_cast<std::size_t>(slot);
    const double range_m = p.norm();
    sums[i] += range_m;
    ++counts[i];
    if (range_m >= bins[i].range_m) continue;
    bins[i].range_m = range_m;
    bins[i].nearest_level_m = p;
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

}  // namespace swiftlet::planning
