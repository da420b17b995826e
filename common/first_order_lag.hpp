// Lags and low-pass filters of first order, in steps of any length.
#pragma once

#include <cmath>

namespace swiftlet::common {

/// The share of a step of its input that a lag of first order with this time constant has followed after `dt_s`; all of
/// it without a lag.
inline double followedShare(double dt_s, double lag_s) { return lag_s > 0.0 ? 1.0 - std::exp(-dt_s / lag_s) : 1.0; }

}  // namespace swiftlet::common
