// Localization in a recorded laser log, or on any robot that carries its laser level: combines LaserFrontEnd and
// Localizer. Each scan is used by only one of them: scans that weigh the particles are withheld from the odometry.
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
  std::uint64_t breaks = 0;  ///< Number of times the odometry lost track.
  LaserSlamCounts front_end;
};

/// Not thread-safe. Deterministic.
class LogLocalizer {
 public:
  LogLocalizer(const common::OccupancyGrid& map, const common::Pose2& T_map_grid, const LogLocalizerConfig& config,
               std::uint64_t seed);

  Localizer& localizer() { return localizer_; }
  /// Processes one scan. nullopt until a scan has had enough points to start with.
  std::optional<LocalizationEstimate> add(const LaserSlamInput& input);

  LogLocalizerCounts counts() const;

 private:
  LaserFrontEnd front_end_;
  Localizer localizer_;
  ScanTurns turns_;
  std::uint64_t breaks_ = 0;
};

}  // namespace swiftlet::perception
