// Tree files that are not UTF-8: other programs and editors write UTF-16, ISO-8859-1 and their kin.
#pragma once

#include <string>
#include <string_view>

namespace swiftlet::tree {

/// "UTF-16LE", "UTF-32BE" ..., with a byte order mark or without, by the zero bytes about the first character, which is
/// `<` or the mark: XML in UTF-8 holds none. Empty for all else.
std::string_view wideEncoding(std::string_view bytes);

/// The encoding of <?xml encoding="..."?>; empty without one.
std::string_view declaredEncoding(std::string_view text);

/// The bytes of a file as UTF-8, with an <?xml encoding="UTF-8"?> that says so where it said another. Bytes that are
/// UTF-8 stay as they are, whatever is declared. So do those in an encoding that the C library does not know, and those
/// that are not what they are declared to be: reading the XML reports them.
std::string inUtf8(std::string bytes);

}  // namespace swiftlet::tree
