// One recorded log, mapped in one way: how far the map is off, and the judgement of the map itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/log_mapping.hpp"
#include "apps/log_variations.hpp"
#include "apps/shared_logs.hpp"

namespace swiftlet::apps {

struct LogRun {
  SharedLog log;
  bool backwards = false;  ///< From the last scan to the first, with the same intervals.
  bool wheels = false;     ///< With the odometry of the log.
  std::optional<LogVariation> variation;

  /// "whole", or "first 800 scans, every second scan".
  std::string part() const;
};

/// All ways to map the logs: forwards and backwards, with and without the odometry of wheels where there is one; as
/// they were recorded, or in each variation instead.
std::vector<LogRun> logRuns(const std::vector<SharedLog>& logs, bool in_variations);

enum class MapVerdict { kRight, kWrong, kByEye };

/// A map is right if the mean error of its relations is at most this many times the best known ...
inline constexpr double kRelationsWithin = 1.5;
/// ... or if the RMS of its trajectory error is at most the greater of these, of which one is a share of the path.
inline constexpr double kAteWithin_m = 0.2;
inline constexpr double kAteShare = 0.002;

struct LogOutcome {
  std::optional<double> relations_mean_m, relations_max_m;
  std::optional<double> ate_rms_m;  ///< After planar alignment.
  double path_m = 0.0;              ///< Of the robot, by the map.
  MapVerdict verdict = MapVerdict::kByEye;
  Trust trust;
  double violation = 0.0;
  std::uint64_t contradictions = 0;
  perception::TrackConnection track;
  double processor_s = 0.0;
};

/// Thread-safe. `system` is a profile of config/systems, or a file. Throws common::InputError.
LogOutcome mapped(const LogRun& run, const std::string& system);

}  // namespace swiftlet::apps
