// A condition that counts once it has held for some time, and until it has been gone for some time.
#pragma once

#include <optional>

#include "common/time.hpp"

namespace swiftlet::common {

/// The outcome of one update of a Hysteresis.
enum class Edge { kNone, kEntered, kLeft };

/// Plain data, one thread.
class Hysteresis {
 public:
  /// Both in seconds; with 0 the condition itself is what counts.
  explicit Hysteresis(double enter_after_s = 0.0, double leave_after_s = 0.0)
      : enter_after_s_(enter_after_s), leave_after_s_(leave_after_s) {}

  Edge update(bool condition, Time now) {
    if (condition == active_) {
      differs_since_.reset();
      return Edge::kNone;
    }
    if (!differs_since_) differs_since_ = now;
    if ((now - *differs_since_).seconds() < (active_ ? leave_after_s_ : enter_after_s_)) return Edge::kNone;
    active_ = condition;
    since_ = *differs_since_;
    differs_since_.reset();
    return active_ ? Edge::kEntered : Edge::kLeft;
  }
  /// As before the first update.
  void reset() { *this = Hysteresis(enter_after_s_, leave_after_s_); }

  bool active() const { return active_; }
  /// Since when the condition has held; only while it is active.
  Time since() const { return since_; }
  /// For how long the condition has held, in seconds; 0 while it is not active.
  double active_s(Time now) const { return active_ ? (now - since_).seconds() : 0.0; }

 private:
  double enter_after_s_, leave_after_s_;
  bool active_ = false;
  Time since_;
  std::optional<Time> differs_since_;  ///< Since when the condition has not been what counts.
};

}  // namespace swiftlet::common
