// Makes text from an input (a file's name or content, an argument) safe to show. A terminal executes control
// characters, and an input must not be able to control the terminal.
#pragma once

#include <string>
#include <string_view>

namespace swiftlet::common {

/// `text` with every control character (C0, DEL, C1) and every byte that is not valid UTF-8 as an escape: "\x1b", "\n".
/// Other text stays as it is, backslashes too, so the result is for people and cannot be parsed back.
std::string printable(std::string_view text);

/// Like printable(), but line ends and tabs stay.
std::string printableLines(std::string_view text);

}  // namespace swiftlet::common
