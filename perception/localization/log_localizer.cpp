#include "perception/localization/log_localizer.hpp"

namespace swiftlet::perception {

LogLocalizer::LogLocalizer(const common::OccupancyGrid& map, const common::Pose2& T_map_grid,
                           const LogLocalizerConfig& config, std::uint64_t seed)
    : front_end_(config.front_end), localizer_(map, T_map_grid, config.localizer, seed) {}

std::optional<LocalizationEstimate> LogLocalizer::add(const LaserSlamInput& input) {
  const auto step =
      front_end_.add(input, [&](const common::Pose2& expected) { return turns_.withholdNext(localizer_, expected); });
  if (!step) return std::nullopt;
  breaks_ += step->broken ? 1 : 0;
  return localizer_.add({step->scan, step->T_odom_robot, step->covariance_since_last, !step->matched, step->broken});
}

LogLocalizerCounts LogLocalizer::counts() const { return {breaks_, front_end_.counts()}; }

}  // namespace swiftlet::perception
