// The status of a maneuver after a step: running, done, or failed with a reason.
#pragma once

#include <string>
#include <utility>

#include "common/intent.hpp"

namespace swiftlet::autonomy {

struct Progress {
  common::IntentState state = common::IntentState::kRunning;
  /// For people: what it does or waits for, what it reached, or why it failed. If it is empty while running, the last
  /// reason stays.
  std::string reason;
  bool inspecting = false;  ///< See IntentStatus; with an empty reason the last one stays.

  static Progress running(std::string reason = {}) { return {common::IntentState::kRunning, std::move(reason), false}; }
  static Progress done(std::string reason) { return {common::IntentState::kSucceeded, std::move(reason), false}; }
  static Progress failed(std::string reason) { return {common::IntentState::kFailed, std::move(reason), false}; }
};

}  // namespace swiftlet::autonomy
