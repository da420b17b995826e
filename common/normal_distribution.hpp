// Constants of the normal distribution.
#pragma once

namespace swiftlet::common {

/// A standard normal variable is within plus and minus this with a probability of 95 %.
inline constexpr double kNormal95 = 1.959964;

/// The standard deviation over the median of the absolute values: 1 / 0.67449, the upper quartile.
inline constexpr double kSigmaOfMedian = 1.4826;

}  // namespace swiftlet::common
