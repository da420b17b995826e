#include "autonomy/health/health_monitor.hpp"

#include <algorithm>
#include <utility>

namespace swiftlet::autonomy {

using common::Edge;
using common::Hysteresis;
using control::Ends;
using control::FlightPhase;
using control::Response;

HealthMonitor::HealthMonitor(const SupervisorConfig& config) : config_(config) {
  for (const Check& check : checks()) states_.emplace_back(check.enter_after_s, check.leave_after_s);
}

void HealthMonitor::update(common::Time now, const VehicleCondition& condition) {
  const FlightPhase phase = control::phaseOf(condition.flight);
  const std::vector<Finding> before = std::exchange(findings_, {});
  entered_.clear();
  left_.clear();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const Check& check = checks()[i];
    Hysteresis& state = states_[i];
    const control::Failsafe* row = control::failsafeFor(check.what, phase);
    const bool final = row != nullptr && row->ends == Ends::kNever && state.active();
    if (row == nullptr || row->response == Response::kRefuseTakeOff) state.reset();
    if (row == nullptr) continue;
    const Reading reading = check.read(condition, config_, false);
    if (row->response == Response::kRefuseTakeOff) {
      if (reading.beyond) findings_.push_back({row, reading, now, check.why(condition, config_), check.concern});
      continue;
    }
    const bool is_so = state.active() ? check.read(condition, config_, true).beyond : reading.beyond;
    const Edge edge = final ? Edge::kNone : state.update(is_so, now);
    if (edge == Edge::kLeft) left_.push_back(check.what);
    if (!state.active()) continue;
    const auto known = std::find(before.begin(), before.end(), check.what);
    // What is within its bound again, but not for long enough, is told as it last was beyond it.
    const bool is_told_now = reading.beyond || known == before.end();
    findings_.push_back(
        {row, reading, state.since(), is_told_now ? check.why(condition, config_) : known->why, check.concern});
    if (edge == Edge::kEntered) entered_.push_back(findings_.back());
  }
}

const Finding* HealthMonitor::find(control::FindingKind what) const {
  const auto found = std::find(findings_.begin(), findings_.end(), what);
  return found == findings_.end() ? nullptr : &*found;
}

}  // namespace swiftlet::autonomy
