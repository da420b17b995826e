// What gzip packed, unpacked as it comes. The archive library does that too, but does not look at the checksum and the
// length that a member ends with: damage that leaves it decodable would give other numbers without a word.
#pragma once

#include <string_view>

#include "interfaces/files/byte_source.hpp"

namespace swiftlet::interfaces {

inline constexpr std::string_view kGzipMagic = "\x1f\x8b\x08";

/// The bytes of all members of `packed`, one behind the other; zeros behind the last are what tapes fill up with. An
/// error says that it is cut or damaged, or that something else follows; what came before it was given.
ByteSource gunzipped(ByteSource packed);

}  // namespace swiftlet::interfaces
