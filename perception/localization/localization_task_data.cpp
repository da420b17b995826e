#include "perception/localization/localization_task_data.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "perception/localization/scan_support.hpp"

namespace swiftlet::perception {
namespace {

/// Distance between points of the local map.
constexpr double kLocalMapSpacing_m = 0.15;
/// Points of the local map that are compared with the map.
constexpr int kLocalMapPoints = 160;
/// With fewer points in the local map nothing is concluded; at most kLocalMapPoints.
constexpr int kLocalMapLeastPoints = 40;

}  // namespace

PlaceDistinction distinctionOf(const LocalizerConfig& config) {
  return {config.search.distinct_m, config.search.distinct_deg * common::kRadPerDeg};
}

LocalizationResult run(const LocalizationTask& task) {
  const LocalizationTask::Data& data = *task.data;
  const LocalizerConfig& config = data.config;
  auto result = std::make_shared<LocalizationResult::Data>();
  result->task = task.data;
  result->whole = data.local_map.whole(kLocalMapSpacing_m, static_cast<std::size_t>(kLocalMapPoints));
  const std::vector<Eigen::Vector2f>& points = result->whole.points_middle_m;
  result->enough_points = static_cast<int>(points.size()) >= kLocalMapLeastPoints;
  if (!result->enough_points) return {std::move(result)};
  // The margin keeps every place that the best cannot be distinguished from: kOthers places just outside it, as in a
  // large building, are together less probable than `ambiguity`.
  constexpr double kOthers = 50.0;
  constexpr double kCoarseness = 0.05;  // Error of a fit on the coarse field.
  const double nats = std::log(kOthers / std::max(config.ambiguity, 1e-6));
  const double margin =
      kCoarseness + nats / (config.point_weight * data.map->topNats() * static_cast<double>(points.size()));
  const GlobalSearchResult found = data.search->search(points, margin);
  result->complete = found.complete;
  result->places = likelyPlaces(bestInstructions(), *data.map, found.places, points, config.point_weight, kTolerance_m,
                                distinctionOf(config));
  return {std::move(result)};
}

}  // namespace swiftlet::perception
