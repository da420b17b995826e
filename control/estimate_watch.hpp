// Watches which parts of the estimate can be used: the findings whose row of the table of fail-safes the flight
// controller follows by itself, whatever flies it.
#pragma once

#include <string>
#include <string_view>

#include "common/event_log.hpp"
#include "common/hysteresis.hpp"
#include "common/time.hpp"
#include "control/failsafe.hpp"

namespace swiftlet::control {

/// One thread. It only remembers since when a part has been lost; what follows is done by its caller.
class EstimateWatch {
 public:
  explicit EstimateWatch(common::EventLog& log) : log_(log) {}

  /// Height and inertial samples, in each tick. `inertial_fault` is empty while the inertial samples can be used.
  void observe(common::Time now, bool vertical_valid, std::string_view inertial_fault);
  /// The horizontal part, in each tick of a controlled flight: kEntered when it is lost. What was lost in one flight
  /// stays lost until it is seen in the next. `carried`: the velocity is known although the position may not be.
  common::Edge observeHorizontal(common::Time now, bool valid, bool carried);

  /// The row of the table for what is lost now, `diverged` included; null if nothing follows from it.
  const Failsafe* active(common::Time now, FlightPhase phase, bool diverged) const;
  /// The sentence about such a finding, for people.
  std::string reason(FindingKind finding) const;
  /// Why the inertial samples cannot be used now; empty if they can.
  const std::string& inertialFault() const { return inertial_fault_; }

 private:
  double horizontalLoss_s() const;

  bool carried_ = false;
  common::Hysteresis horizontal_lost_, vertical_lost_, inertial_lost_;
  std::string inertial_fault_;
  common::EventLog& log_;
};

}  // namespace swiftlet::control
