// The data that the localizer and the thread that searches the map exchange. Private to localization.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "perception/localization/local_map.hpp"
#include "perception/localization/localization_task.hpp"
#include "perception/localization/localizer_config.hpp"
#include "perception/localization/place_posterior.hpp"

namespace swiftlet::perception {

/// State at the time the search was requested.
struct LocalizationTask::Data {
  std::uint64_t epoch = 0;
  bool doubted = false;  ///< The vehicle is localized; the search looks for a better place.
  LocalMap local_map{0.0};
  std::vector<Eigen::Vector2f> scan_body_m;
  common::Pose2 T_odom_scan;
  double path_length_m = 0.0;
  LocalizerConfig config;
  std::shared_ptr<const MapField> map;
  std::shared_ptr<const GlobalSearch> search;
};

struct LocalizationResult::Data {
  std::shared_ptr<const LocalizationTask::Data> task;
  LocalMap::Whole whole;
  bool enough_points = false;
  std::vector<LikelyPlace> places;
  bool complete = true;
};

PlaceDistinction distinctionOf(const LocalizerConfig& config);

}  // namespace swiftlet::perception
