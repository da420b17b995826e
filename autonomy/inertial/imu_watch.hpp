// Notices inertial samples that cannot be used: none arrive, they are not finite, they are old, or they repeat.
#pragma once

#include <optional>
#include <string_view>

#include "common/sensor_event.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// Whether all its numbers are.
bool isFinite(const common::ImuSample& sample);

/// One thread. A sample that is not finite is left out. A sensor that measures never gives the same numbers many
/// times in a row, so samples that are equal bit by bit come from a driver that repeats its last one. The same holds
/// for the attitude alone, whose noise is about a degree: while the gyroscopes measure, an attitude that repeats is
/// that of an AHRS that has stopped, in a hover too; and, within thrice the time, for the rates or the forces alone.
class ImuWatch {
 public:
  void add(const common::ImuSample& sample);
  /// The newest samples are an old one that a driver repeats: they do not measure the motion, and must not be
  /// integrated.
  bool repeats() const;
  /// What is wrong at `now`, for people; empty if nothing is, and before the first sample. A view of a literal: a tick
  /// in which the samples cannot be used allocates nothing either.
  std::string_view fault(common::Time now) const;

 private:
  std::optional<common::ImuSample> last_;  ///< The last finite sample.
  bool finite_ = true;                     ///< Whether the last sample was finite.
  /// Stamps of the last samples whose part of it differed from the one before.
  common::Time rates_changed_, force_changed_, attitude_changed_;
};

}  // namespace swiftlet::autonomy
