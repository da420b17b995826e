// Notices inertial samples that cannot be used: none arrive, they are not finite, they are old, or they repeat.
#pragma once

#include <optional>
#include <string_view>

#include "common/config_fwd.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

struct ImuWatchConfig {
  static constexpr double silent_s = 0.08;  ///< Without a finite inertial sample for this long the sensor is silent.
  static constexpr double late_s = 0.1;     ///< Greatest age of the newest inertial sample, by its time of measurement.
  static constexpr double repeats_s =
      0.06;  ///< Samples, or attitudes alone, that are equal bit by bit for longer than this are repeated ones.
};

/// Whether all its numbers are.
bool isFinite(const common::ImuSample& sample);

/// One thread. A sample that is not finite is left out. A sensor that measures never gives the same numbers many
/// times in a row, so samples that are equal bit by bit come from a driver that repeats its last one. The same holds
/// for the attitude alone, whose noise is about a degree: while the gyroscopes measure, an attitude that repeats is
/// that of an AHRS that has stopped, in a hover too; and, within thrice the time, for the rates or the forces alone.
class ImuWatch {
 public:
  explicit ImuWatch(const ImuWatchConfig& config) : config_(config) {}

  void add(const common::ImuSample& sample);
  /// The newest samples are an old one that a driver repeats: they do not measure the motion, and must not be
  /// integrated.
  bool repeats() const;
  /// What is wrong at `now`, for people; empty if nothing is, and before the first sample. A view of a literal: a tick
  /// in which the samples cannot be used allocates nothing either.
  std::string_view fault(common::Time now) const;

 private:
  ImuWatchConfig config_;
  std::optional<common::ImuSample> last_;  ///< The last finite sample.
  bool finite_ = true;                     ///< Whether the last sample was finite.
  /// Stamps of the last samples whose part of it differed from the one before.
  common::Time rates_changed_, force_changed_, attitude_changed_;
};

}  // namespace swiftlet::autonomy
