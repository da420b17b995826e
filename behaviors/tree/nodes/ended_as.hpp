// How decorators change the result of their child.
#pragma once

#include "behaviors/tree/status.hpp"

namespace swiftlet::tree {

/// SUCCESS becomes `success` and FAILURE becomes `failure`; RUNNING and SKIPPED stay.
constexpr Status endedAs(Status status, Status success, Status failure) {
  if (status == Status::kSuccess) return success;
  return status == Status::kFailure ? failure : status;
}

}  // namespace swiftlet::tree
