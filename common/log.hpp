// What the program says on standard error. Libraries report through return values and Events; this is for apps and for
// what cannot be said otherwise. Thread-safe.
#pragma once

#include <string_view>

namespace swiftlet::common::log {

void info(std::string_view text);
void warning(std::string_view text);
void error(std::string_view text);

}  // namespace swiftlet::common::log
