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

std::optional<Status> answerFrom(std::string_view text) {
  for (const Status answer : {Status::kSuccess, Status::kFailure, Status::kRunning, Status::kSkipped})
    if (text == toString(answer)) return answer;
  return std::nullopt;
}

}  // namespace swiftlet::tree
