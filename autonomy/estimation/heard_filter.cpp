#include "autonomy/estimation/heard_filter.hpp"

#include <fmt/format.h>

namespace swiftlet::autonomy {

bool HeardFilter::uses(perception::OdometrySource source, const std::optional<perception::Measurement>& measurement,
                       common::Time now, common::EventLog& log) {
  const double deviation_m = measurement ? perception::deviation_m(*measurement) : perception::OdometryChoice::kNothing;
  if (const auto change = choice_.measured(source, deviation_m, now))
    log.info(now, "fusion", fmt::format("odometry switched to {}", perception::toString(change->to)),
             fmt::format("standard deviations: {} {:.1f} mm, {} {:.1f} mm", perception::toString(change->to),
                         1e3 * change->to_m, perception::toString(change->from), 1e3 * change->from_m));
  return measurement && choice_.uses(source, now);
}

void HeardFilter::reportHealth(common::Time now, common::EventLog& log) {
  using common::Severity;
  using perception::FusionStatus;
  if (filter_.status() == reported_) return;
  const auto health = filter_.health();
  const Severity severity = health.status == FusionStatus::kOk         ? Severity::kInfo
                            : health.status == FusionStatus::kDiverged ? Severity::kError
                                                                       : Severity::kWarning;
  log.add({now,
           severity,
           "fusion",
           fmt::format("estimate {}", perception::toString(health.status)),
           health.reason,
           {},
           common::Concern::kEstimate});
  reported_ = health.status;
}

}  // namespace swiftlet::autonomy
