// For headers that declare a Config with `void describe(common::config::Fields& fields)` and, if fields depend on each
// other, `std::vector<Problem> validate() const`. The source includes common/config_fields.hpp.
#pragma once

#include <string>
#include <vector>

namespace swiftlet::common {
struct Problem;
}  // namespace swiftlet::common

namespace swiftlet::common::config {
class Fields;
}  // namespace swiftlet::common::config
