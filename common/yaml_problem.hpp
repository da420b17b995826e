// What a text that is not YAML is told.
#pragma once

#include <string>
#include <string_view>

#include "common/error.hpp"

namespace swiftlet::common {

/// `message` is that of the YAML library, `location` where it noticed, with the line counted from 1. Tabs that indent
/// this line or the one above are named as the cause.
Problem notYaml(std::string_view text, const SourceLocation& location, const std::string& message);

}  // namespace swiftlet::common
