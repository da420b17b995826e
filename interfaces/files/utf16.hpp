// Texts in UTF-16, as editors and shells of Windows save them.
#pragma once

#include <optional>
#include <string_view>

#include "interfaces/files/byte_source.hpp"

namespace swiftlet::interfaces {

enum class ByteOrder { kLittleEndian, kBigEndian };

/// By the byte order mark that a file begins with; none for any other beginning.
std::optional<ByteOrder> utf16OrderOf(std::string_view beginning);

/// The text of `utf16` as UTF-8, without the byte order mark. What is no character becomes U+FFFD.
ByteSource utf8From(ByteSource utf16, ByteOrder order);

}  // namespace swiftlet::interfaces
