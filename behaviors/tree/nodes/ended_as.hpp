// How nodes change the result of a child.
#pragma once

#include "behaviors/tree/status.hpp"

namespace swiftlet::tree {

/// SUCCESS becomes `success` and FAILURE becomes `failure`; RUNNING and SKIPPED stay.
constexpr Status endedAs(Status status, Status success, Status failure) {
  if (status == Status::kSuccess) return success;
  return status == Status::kFailure ? failure : status;
}

/// For a node that has ticked another child before: it did something, so it is not SKIPPED.
constexpr Status skippedAsSuccess(Status status) { return status == Status::kSkipped ? Status::kSuccess : status; }

}  // namespace swiftlet::tree
