// Text of an input (a file's name or content, an argument) as it may be shown: a terminal takes control characters for
// commands, and what an input holds must not command it.
#pragma once

#include <string>
#include <string_view>

namespace swiftlet::common {

/// `text` with every control character (C0, DEL, C1) and every byte that is not valid UTF-8 as an escape: "\x1b", "\n".
/// Other text is left as it is, backslashes too: what comes out is for people, not to be read back.
std::string printable(std::string_view text);

/// The same, but lines end where they do, and tabs stay.
std::string printableLines(std::string_view text);

}  // namespace swiftlet::common
