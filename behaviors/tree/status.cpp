#include "behaviors/tree/status.hpp"

namespace swiftlet::tree {

const char* toString(Status status) {
  switch (status) {
    case Status::kIdle:
      return "IDLE";
    case Status::kRunning:
      return "RUNNING";
    case Status::kSuccess:
      return "SUCCESS";
    case Status::kFailure:
      return "FAILURE";
    case Status::kSkipped:
      return "SKIPPED";
    case Status::kSuspended:
      return "SUSPENDED";
  }
  return "?";
}

}  // namespace swiftlet::tree
