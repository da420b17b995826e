// Splits the request target into path and query, percent-decoded.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace swiftlet::web {

struct Target {
  std::string path;  ///< Starts with '/'; without "..", control characters or NUL.
  std::map<std::string, std::string> query;
};

/// Or in words what is wrong: the target is not an absolute path, has a broken escape, a control character or a ".."
/// segment, or names a query key twice.
tl::expected<Target, std::string> parseTarget(std::string_view target);

/// The parts of "http://localhost:8080/api/state", the absolute form of a target (RFC 9112, 3.2.2).
struct AbsoluteTarget {
  std::string authority;  ///< "localhost:8080", which takes the place of the Host header.
  std::string target;     ///< "/api/state", as parseTarget() takes it.
};
/// Nothing for a target in another form.
std::optional<AbsoluteTarget> absoluteTarget(std::string_view target);

/// Lower case, without the port and the brackets of an IPv6 address: "[::1]:8080" is "::1". Nothing if malformed.
std::optional<std::string> hostName(std::string_view host_header);

/// An IPv4 or IPv6 address in digits, which no foreign name server can control.
bool isAddressLiteral(std::string_view host_name);

}  // namespace swiftlet::web
