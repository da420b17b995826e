// Watches which parts of the estimate can be used: the findings whose row of the table of fail-safes the flight
// controller follows by itself, whatever flies it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/time.hpp"
#include "control/failsafe.hpp"

namespace swiftlet::control {

/// One thread. It only remembers since when a part has been lost; what follows is done by its caller.
class EstimateWatch {
 public:
  /// What a tick changed in a part of the estimate.
  enum class Change { kNone, kLost, kBack };

  /// Height and inertial samples, in each tick. `inertial_fault` is empty while the inertial samples can be used.
  /// Returns the change of the inertial samples.
  Change observe(common::Time now, bool vertical_valid, std::string_view inertial_fault);
  /// The horizontal part, in each tick of a controlled flight. What was lost in one flight stays lost until it is seen
  /// in the next.
  Change observeHorizontal(common::Time now, bool valid);

  /// The row of the table for what is lost now, `diverged` included; null if nothing follows from it.
  const Failsafe* active(common::Time now, FlightPhase phase, bool diverged) const;
  /// The sentence about such a finding, for people.
  std::string reason(FindingKind finding) const;
  /// Why the inertial samples cannot be used now; empty if they can.
  const std::string& inertialFault() const { return inertial_fault_; }

 private:
  std::optional<common::Time> horizontal_lost_;
  std::optional<common::Time> vertical_lost_;
  std::optional<common::Time> inertial_lost_;
  std::string inertial_fault_;
};

}  // namespace swiftlet::control
