// Base64 (RFC 4648), for pictures inside HTML and SVG.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace swiftlet::common {

std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace swiftlet::common
