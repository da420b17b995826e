// The computing resources that a flight used. They differ between runs, so nothing of them may enter the state of
// a flight, or a file that a seed makes the same again.
#pragma once

#include <optional>

namespace swiftlet::common {

/// Each is nullopt if it was not measured.
struct MachineUse {
  /// Most resident memory of the process during the flight, in 10^6 bytes. Flights side by side share it.
  std::optional<double> memory_peak_MB;
  /// Processor time that the 3D map takes for a frame of the camera: medians of the first and of the last tenth of the
  /// frames.
  std::optional<double> frame_first_ms;
  std::optional<double> frame_last_ms;

  /// Processor time of a planning job, the cost map's update with it: the median, and the greatest.
  std::optional<double> plan_median_ms = std::nullopt;
  std::optional<double> plan_max_ms = std::nullopt;

  /// How much longer a frame takes at the end than at the start.
  std::optional<double> frameGrowth() const {
    if (!frame_first_ms || !frame_last_ms || *frame_first_ms <= 0.0) return std::nullopt;
    return *frame_last_ms / *frame_first_ms;
  }
};

}  // namespace swiftlet::common
