// Characters of UTF-8.
#pragma once

namespace swiftlet::tree {

/// Whether a byte goes on with a character that began before it.
constexpr bool continuesCharacter(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

}  // namespace swiftlet::tree
