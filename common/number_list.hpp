// Lists of numbers as people write them by hand.
#pragma once

#include <string>
#include <string_view>

namespace swiftlet::common {

/// "[-1.55, -1.55, 0]" of "-1.55 -1.55 0", "-1,55; -1,55; 0" and "(-1.55, -1.55, 0)"; empty for a text that is no list
/// of numbers.
std::string numberListOf(std::string_view written);

/// "write `[1, 2]`" of such a text, or how a list is written.
std::string numberListHint(std::string_view written);

}  // namespace swiftlet::common
