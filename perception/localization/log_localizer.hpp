// Localization in a recorded laser log, or on any robot that carries its laser level: LaserFrontEnd and Localizer in
// one. Each scan serves either of the two: those that weigh particles are kept from the odometry.
#pragma once

#include <cstdint>
#include <optional>

#include "perception/laser_odometry/laser_front_end.hpp"
#include "perception/localization/localizer.hpp"
#include "perception/localization/scan_turns.hpp"

namespace swiftlet::perception {

struct LogLocalizerConfig {
  LaserFrontEndConfig front_end;
  LocalizerConfig localizer;
};

struct LogLocalizerCounts {
  std::uint64_t breaks = 0;  ///< Times the odometry lost the thread.
  LaserSlamCounts front_end;
};

/// Not thread-safe. Deterministic.
class LogLocalizer {
 public:
  LogLocalizer(const common::OccupancyGrid& map, const common::Pose2& T_map_grid, const LogLocalizerConfig& config,
               std::uint64_t seed);

  Localizer& localizer() { return localizer_; }
  /// None as long as no scan has had enough points to begin with.
  std::optional<LocalizationEstimate> add(const LaserSlamInput& input);

  LogLocalizerCounts counts() const;

 private:
  LaserFrontEnd front_end_;
  Localizer localizer_;
  ScanTurns turns_;
  std::uint64_t breaks_ = 0;
};

}  // namespace swiftlet::perception
