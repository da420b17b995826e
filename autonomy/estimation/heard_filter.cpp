#include "autonomy/estimation/heard_filter.hpp"

#include <fmt/format.h>

namespace swiftlet::autonomy {

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
