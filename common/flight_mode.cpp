#include "common/flight_mode.hpp"

namespace swiftlet::common {

const char* toString(FlightMode mode) {
  switch (mode) {
    case FlightMode::kFast:
      return "fast";
    case FlightMode::kCareful:
      return "careful";
    case FlightMode::kAccurate:
      return "accurate";
    case FlightMode::kBrisk:
      return "brisk";
  }
  return "";
}

}  // namespace swiftlet::common
