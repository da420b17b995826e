#include "web/server/public_url.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "web/server/target.hpp"

namespace swiftlet::web {
namespace {

using common::Message;

constexpr const char* kPublicExample = "https://field.example/swiftlet/";

/// "https://field.example/swiftlet/" in its three parts.
struct Parts {
  std::string scheme;  ///< Lower case; empty if there is none.
  std::string_view authority;
  std::string_view rest;  ///< The path and what follows it.
};

Parts partsOf(std::string_view text) {
  constexpr std::string_view kMark = "://";
  const std::size_t mark = text.find(kMark);
  if (mark == std::string_view::npos) return {"", text, ""};
  const std::string_view behind = text.substr(mark + kMark.size());
  const std::size_t end = std::min(behind.find_first_of("/?#"), behind.size());
  return {common::lowerCase(text.substr(0, mark)), behind.substr(0, end), behind.substr(end)};
}

std::optional<Origin> originOf(const Parts& parts) {
  const auto authority = parseAuthority(parts.authority);
  if (portOf(parts.scheme) == 0 || !authority) return std::nullopt;
  return Origin{parts.scheme, authority->host, authority->port.value_or(portOf(parts.scheme))};
}

[[noreturn]] void fail(const std::string& text, const Message& message, const std::string& hint) {
  throw common::InputError({}, "--public-url", message.behind(fmt::format("`{}` ", text)), hint);
}

void checkScheme(const std::string& text, const Parts& parts) {
  if (portOf(parts.scheme) != 0) return;
  if (parts.scheme.empty()) {
    const std::string word = common::lowerCase(text.substr(0, text.find_first_of(":/")));
    const bool is_scheme = word == "http" || word == "https";
    const std::size_t host = is_scheme ? text.find_first_not_of(":/", word.size()) : text.find_first_not_of('/');
    fail(text, Message("url.no-scheme", "does not say whether it is http or https"),
         host == std::string::npos ? fmt::format("write an address such as {}", kPublicExample)
                                   : fmt::format("write http://{0} or https://{0}", text.substr(host)));
  }
  const std::string_view behind = std::string_view(text).substr(text.find("://"));
  if (parts.scheme == "ws" || parts.scheme == "wss")
    fail(text, Message("url.of-websocket", "is the address of a WebSocket, not of the page"),
         fmt::format("write {}{}", parts.scheme == "ws" ? "http" : "https", behind));
  fail(text, Message("url.other-scheme", "is neither http nor https"), fmt::format("write https{}", behind));
}

}  // namespace

int portOf(std::string_view scheme) { return scheme == "http" ? 80 : scheme == "https" ? 443 : 0; }

std::optional<Origin> parseOrigin(std::string_view text) {
  const Parts parts = partsOf(text);
  return parts.rest.empty() ? originOf(parts) : std::nullopt;
}

std::string toString(const Origin& origin) {
  const bool v6 = origin.host.find(':') != std::string::npos;
  return fmt::format("{}://{}{}", origin.scheme, v6 ? "[" + origin.host + "]" : origin.host,
                     origin.port == portOf(origin.scheme) ? "" : fmt::format(":{}", origin.port));
}

PublicUrl parsePublicUrl(const std::string& text) {
  const Parts parts = partsOf(text);
  checkScheme(text, parts);
  std::string_view path = parts.rest.substr(0, parts.rest.find_first_of("?#"));
  const std::string_view surplus = parts.rest.substr(path.size());
  if (path.ends_with("/index.html")) path.remove_suffix(std::string_view("index.html").size());
  const std::string slashed = std::string(path) + (path.ends_with('/') ? "" : "/");
  const std::size_t host = parts.authority.rfind('@') + 1;  // 0 if there is no user.
  const std::string bare = fmt::format("{}://{}{}", parts.scheme, parts.authority.substr(host), slashed);
  if (host > 0) fail(text, Message("url.user", "has a user or a password in it"), fmt::format("write {}", bare));
  const auto origin = originOf(parts);
  if (!origin)
    fail(text, Message("url.no-host", "names no host, or a wrong port: `{}`", parts.authority),
         fmt::format("write one host, and perhaps a port, as in {}", kPublicExample));
  if (!surplus.empty())
    fail(text, Message("url.more-than-path", "has more than a path: `{}`", surplus), fmt::format("write {}", bare));
  const auto target = parseTarget(slashed);
  if (!target || target->path.find("//") != std::string::npos)
    fail(text, Message("url.malformed-path", "has a malformed path: `{}`", path),
         fmt::format("write a path as in {}", kPublicExample));
  return {*origin, target->path, toString(*origin) + slashed};
}

}  // namespace swiftlet::web
