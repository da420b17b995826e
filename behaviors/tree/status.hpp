// The words of the engine: the status of a node, and whether it has been released.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace swiftlet::tree {

/// kIdle: not ticked since its parent started. kSuccess, kFailure and kSkipped: its last result. kRunning and
/// kSuspended: it is under way. tick() never returns kIdle or kSuspended.
enum class Status : unsigned char { kIdle, kRunning, kSuccess, kFailure, kSkipped, kSuspended };

/// "IDLE", "RUNNING", "SUCCESS", "FAILURE", "SKIPPED", "SUSPENDED".
const char* toString(Status status);

/// The answer that a port names: SUCCESS, FAILURE, RUNNING or SKIPPED; nothing for any other text.
std::optional<Status> answerFrom(std::string_view text);

/// Under way: it keeps its progress, and a tick continues it instead of starting over.
constexpr bool isActive(Status status) { return status == Status::kRunning || status == Status::kSuspended; }

/// The answer of a node that is being released: not yet (call again at the next tick), or done.
enum class Release : unsigned char { kLettingGo, kReleased };

constexpr Release both(Release a, Release b) {
  return a == Release::kReleased && b == Release::kReleased ? Release::kReleased : Release::kLettingGo;
}

}  // namespace swiftlet::tree
