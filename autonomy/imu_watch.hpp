// Notices inertial samples that cannot be used: none arrive, they are old, or they repeat.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

struct ImuWatchConfig {
  double silent_s = 0.1;
  double repeats_s = 0.06;
  double ahrs_turn_deg = 1.0;

  void describe(common::config::Fields& fields);
};

/// One thread. A sensor that measures never gives the same six numbers twice in a row for long, so samples that are
/// equal bit by bit come from a driver that repeats its last one. An attitude that stays the same bit by bit while the
/// gyroscopes turn is that of an AHRS that has stopped.
class ImuWatch {
 public:
  explicit ImuWatch(const ImuWatchConfig& config) : config_(config) {}

  void add(const common::ImuSample& sample);
  /// What is wrong at `now`, for people; empty if nothing is, and before the first sample.
  std::string fault(common::Time now) const;

 private:
  ImuWatchConfig config_;
  std::optional<common::ImuSample> last_;
  common::Time changed_;     ///< Stamp of the last sample that differed from the one before.
  double turned_rad_ = 0.0;  ///< By the gyroscopes, since the attitude last changed.
};

}  // namespace swiftlet::autonomy
