// Unpacks gzip as a stream. The archive library can do that too, but it does not check the checksum and the length at
// the end of a member: damage that can still be decoded would silently give wrong numbers.
#pragma once

#include <string_view>

#include "interfaces/files/byte_source.hpp"

namespace swiftlet::interfaces {

inline constexpr std::string_view kGzipMagic = "\x1f\x8b\x08";

/// The bytes of all members of `packed`, one after the other; zeros after the last member are padding and ignored. An
/// error says that the data are cut or damaged, or that something else follows; the bytes before it were returned.
ByteSource gunzipped(ByteSource packed);

}  // namespace swiftlet::interfaces
