// Text inside HTML, SVG and XML.
#pragma once

#include <string>
#include <string_view>

namespace swiftlet::common {

/// The text escaped for use between tags and in quoted attributes. Bytes that are not UTF-8 become U+FFFD.
std::string escaped(std::string_view text);

}  // namespace swiftlet::common
