// Splits the request target into path and query, percent-decoded.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "common/message.hpp"
#include "web/server/request.hpp"

namespace swiftlet::web {

struct Target {
  std::string path;  ///< Starts with '/'; without "..", control characters or NUL.
  std::map<std::string, std::string> query;
};

/// Or what is wrong: the target is not an absolute path, has a broken escape, a control character or a ".." segment, or
/// names a query key twice.
tl::expected<Target, common::Message> parseTarget(std::string_view target);

/// The request with a target that parseTarget() takes. One in the absolute form, "http://localhost:8080/api/state"
/// (RFC 9112, 3.2.2), brings its own host, which takes the place of the Host header.
Request inOriginForm(Request request);

/// A host and perhaps a port, as in a Host header: "[::1]:8080" is {"::1", 8080}.
struct Authority {
  std::string host;  ///< Lower case; an IPv6 address without its brackets and in its shortest form.
  std::optional<int> port;
};
/// nullopt if malformed.
std::optional<Authority> parseAuthority(std::string_view text);

/// Whether the host of an Authority is an IPv4 or IPv6 address in digits, which no foreign name server can control.
bool isAddressLiteral(std::string_view host);

}  // namespace swiftlet::web
