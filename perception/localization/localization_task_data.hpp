// What travels between the localizer and the thread that searches the whole map; private to localization.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "perception/localization/local_map.hpp"
#include "perception/localization/localization_task.hpp"
#include "perception/localization/localizer_config.hpp"
#include "perception/localization/place_posterior.hpp"

namespace swiftlet::perception {

/// As it was when the search was asked for.
struct LocalizationTask::Data {
  std::uint64_t epoch = 0;
  bool doubted = false;  ///< It is believed to be somewhere, and looked for elsewhere.
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
