// What people who wrote a number by hand are told when it cannot be read.
#pragma once

#include <string>
#include <string_view>

namespace swiftlet::common {

/// How to write a number that was written as `0,5`, `0.5 m`, `90°`, `1'000` or `1#comment`; empty if that is unknown.
/// The unit is compared with the end of the key's name, `range_m`; a key may have none, and an option of the command
/// line is no key: "". Another unit is never dropped, because the number would mean another value.
std::string numberHint(std::string_view key, std::string_view written, bool whole = false);

}  // namespace swiftlet::common
