// The two stamps of a measurement.
#pragma once

#include "common/time.hpp"

namespace swiftlet::common {

struct Stamps {
  Time measured;  ///< For sensors that sweep, the time of the first beam or image row.
  Time arrived;   ///< Time from which the autonomy may use it; never before `measured`.
};

}  // namespace swiftlet::common
