// The encodings of SDF files: other programs and editors write UTF-16, ISO-8859-1, KOI8-R and their kin.
#pragma once

#include <string>
#include <string_view>

namespace swiftlet::simulation {

/// The text of a file as UTF-8 without a byte order mark. UTF-16 and UTF-32 are recognised by their first bytes. Bytes
/// that are UTF-8 stay, whatever <?xml encoding="..."?> declares. Other bytes are of the encoding that is declared, or
/// of ISO-8859-1 if it is missing or UTF-8. Throws common::InputError for an encoding that the C library does not know
/// and for bytes that are not of it. `file` is for messages.
std::string utf8Text(const std::string& file, std::string_view bytes);

}  // namespace swiftlet::simulation
