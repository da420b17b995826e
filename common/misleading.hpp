// Characters that mislead the reader of a text: they cannot be seen, or look like one of ASCII.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace swiftlet::common {

struct Misleading {
  std::size_t offset = 0;  ///< In bytes, from 0.
  std::string what;        ///< "a no-break space (U+00A0)".
  std::string instead;     ///< "a plain blank", "nothing there", "`-`".
};

/// The first one of a text: also a letter of Greek or Cyrillic beside one of ASCII, which may be meant. The texts of
/// missions are judged alike (behaviors/tree/characters.hpp).
std::optional<Misleading> misleadingIn(std::string_view text);

/// "it has a zero-width space (U+200B): write nothing there"; empty for a text without misleading characters.
std::string misleadingHint(std::string_view text);

/// The text as it is seen: without what cannot be seen, and with the characters of ASCII that others look like. Letters
/// stay as they are.
std::string asSeen(std::string_view text);

}  // namespace swiftlet::common
