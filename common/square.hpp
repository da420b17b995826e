// The square of an expression that is too long to write twice.
#pragma once

namespace swiftlet::common {

constexpr double square(double x) { return x * x; }

}  // namespace swiftlet::common
