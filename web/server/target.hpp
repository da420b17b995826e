// Splits the request target into path and query, percent-decoded.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace swiftlet::web {

struct Target {
  std::string path;  ///< Starts with '/'; without "..", control characters or NUL.
  std::map<std::string, std::string> query;
};

/// Nothing if the target is not an absolute path, has a broken escape, a control character or a ".." segment, or names
/// a query key twice.
std::optional<Target> parseTarget(std::string_view target);

/// Lower case, without the port and the brackets of an IPv6 address: "[::1]:8080" is "::1". Nothing if malformed.
std::optional<std::string> hostName(std::string_view host_header);

/// An IPv4 or IPv6 address in digits, which no foreign name server can control.
bool isAddressLiteral(std::string_view host_name);

}  // namespace swiftlet::web
