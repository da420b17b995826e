// What a header needs that declares a Config: `void describe(common::config::Fields& fields)` and, where fields depend
// on each other, `std::vector<std::string> validate() const`. The source includes common/config_fields.hpp.
#pragma once

#include <string>
#include <vector>

namespace swiftlet::common::config {
class Fields;
}  // namespace swiftlet::common::config
