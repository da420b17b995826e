// Characters that mislead: they cannot be seen, or look like another one. A message that quotes one names it by its
// code point.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace swiftlet::tree {

/// Length in bytes of the character of UTF-8 that begins at `offset`; 0 if none does.
std::size_t characterLength(std::string_view text, std::size_t offset);
/// Whether the whole text is UTF-8.
bool isUtf8(std::string_view text);

/// "U+200B (zero width space, take it out)", "U+2212 (minus sign, write `-`)", or "U+00E9" for one that is not
/// misleading.
std::string nameOfCharacter(std::string_view text, std::size_t offset);
/// The name of the first misleading character: one that cannot be seen, that looks like a sign of ASCII, or a letter
/// of another script beside one of ASCII. Empty without one.
std::string misleadingCharacterIn(std::string_view text);

/// The text as it is seen: without what cannot be seen, and with the signs of ASCII that others look like.
std::string asSeen(std::string_view text);

}  // namespace swiftlet::tree
