#include "common/world/frontier.hpp"

#include "common/check.hpp"

namespace swiftlet::common {

const char* toString(FrontierReason reason) {
  switch (reason) {
    case FrontierReason::kOpen:
      return "open";
    case FrontierReason::kTooSmall:
      return "too small";
    case FrontierReason::kUnreachable:
      return "unreachable";
    case FrontierReason::kBlocked:
      return "blocked";
    case FrontierReason::kOutOfBounds:
      return "out of bounds";
    case FrontierReason::kBlacklisted:
      return "blacklisted";
    case FrontierReason::kPositionUncertain:
      return "position uncertain";
  }
  SWIFTLET_CHECK(false, static_cast<int>(reason));
}

}  // namespace swiftlet::common
