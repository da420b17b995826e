// Addresses of files, as other programs write them where a path is expected: file:///maps/my%20hall.sdf.
#pragma once

#include <string>
#include <string_view>

namespace swiftlet::common {

/// The text with "%20" and the like replaced by what they stand for.
std::string percentDecoded(std::string_view text);

/// The path of a `file://` address of this machine; other names stay as they are.
std::string pathOfAddress(std::string_view name);

}  // namespace swiftlet::common
