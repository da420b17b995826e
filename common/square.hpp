// For what is a name or an expression long enough not to be written twice.
#pragma once

namespace swiftlet::common {

constexpr double square(double x) { return x * x; }

}  // namespace swiftlet::common
