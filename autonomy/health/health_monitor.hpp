// Evaluates the checks at each tick and keeps what is found.
#pragma once

#include <vector>

#include "autonomy/health/checks.hpp"
#include "autonomy/health/supervisor_config.hpp"
#include "common/hysteresis.hpp"
#include "common/time.hpp"
#include "control/failsafe.hpp"

namespace swiftlet::autonomy {

/// One thread. A check that has no row in the table of fail-safes for the present phase finds nothing then.
class HealthMonitor {
 public:
  explicit HealthMonitor(const SupervisorConfig& config);

  void update(common::Time now, const VehicleCondition& condition);

  /// What is found now, in the order of checks().
  const std::vector<Finding>& findings() const { return findings_; }
  /// What began, and what ended, at the last update.
  const std::vector<Finding>& entered() const { return entered_; }
  const std::vector<control::FindingKind>& left() const { return left_; }
  /// Null if it is not found now.
  const Finding* find(control::FindingKind what) const;

 private:
  SupervisorConfig config_;
  std::vector<common::Hysteresis> states_;  ///< In the order of checks().
  std::vector<Finding> findings_, entered_;
  std::vector<control::FindingKind> left_;
};

}  // namespace swiftlet::autonomy
