#include "web/server/target.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

#include <fmt/format.h>

#include "common/lower_case.hpp"
#include "web/server/refusal.hpp"

namespace swiftlet::web {
namespace {

using common::Message;

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::optional<std::string> decoded(std::string_view text, bool plus_is_blank) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      if (i + 2 >= text.size()) return std::nullopt;
      const int high = hexDigit(text[i + 1]), low = hexDigit(text[i + 2]);
      if (high < 0 || low < 0) return std::nullopt;
      c = static_cast<char>(high * 16 + low);
      i += 2;
    } else if (c == '+' && plus_is_blank) {
      c = ' ';
    }
    if (static_cast<unsigned char>(c) < 32 || c == 127) return std::nullopt;
    result += c;
  }
  return result;
}

bool climbs(std::string_view path) {
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    if (path.substr(begin, end - begin) == "..") return true;
    begin = end + 1;
  }
  return false;
}

Message malformed(std::string_view target) {
  return Message("request.malformed-address", "the address {} is malformed", shown(target));
}

/// Of ":8080"; 0 without a port, nullopt where it is malformed.
std::optional<int> portIn(std::string_view text) {
  if (text.empty() || text == ":") return 0;
  int port = 0;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), port);
  const bool sound = text.front() == ':' && error == std::errc() && end == text.data() + text.size();
  return sound && port > 0 && port <= 65535 ? std::optional(port) : std::nullopt;
}

/// In lower case and without the dot that may end a complete name.
std::optional<std::string> nameIn(std::string_view text) {
  if (text.ends_with('.')) text.remove_suffix(1);
  const auto sound = [](unsigned char c) { return std::isalnum(c) || c == '.' || c == '-' || c == '_'; };
  if (text.empty() || !std::all_of(text.begin(), text.end(), sound)) return std::nullopt;
  return common::lowerCase(text);
}

/// Of an IPv6 address, so that equal ones compare as equal.
std::optional<std::string> shortestForm(std::string_view text) {
  in6_addr address{};
  std::array<char, INET6_ADDRSTRLEN> shortest{};
  const bool sound = text.find('\0') == std::string_view::npos;
  if (!sound || inet_pton(AF_INET6, std::string(text).c_str(), &address) != 1) return std::nullopt;
  return inet_ntop(AF_INET6, &address, shortest.data(), shortest.size());
}

/// What is wrong with it; nullopt if nothing is.
std::optional<Message> parseQuery(std::string_view target, std::map<std::string, std::string>& query) {
  std::string_view text = target.substr(target.find('?') + 1);
  while (!text.empty()) {
    const std::string_view pair = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(pair.size() + 1, text.size()));
    if (pair.empty()) continue;
    const std::size_t equals = pair.find('=');
    const auto key = decoded(pair.substr(0, equals), true);
    const auto value = equals == std::string_view::npos ? std::string() : decoded(pair.substr(equals + 1), true);
    if (!key || !value) return malformed(target);
    if (!query.emplace(*key, *value).second) return Message("query.parameter-twice", "{} is given twice", shown(*key));
  }
  return std::nullopt;
}

}  // namespace

tl::expected<Target, Message> parseTarget(std::string_view target) {
  if (target.empty() || target.front() != '/') return tl::unexpected(malformed(target));
  const std::size_t question = target.find('?');
  const auto path = decoded(target.substr(0, question), false);
  if (!path || climbs(*path)) return tl::unexpected(malformed(target));
  Target result{*path, {}};
  if (question == std::string_view::npos) return result;
  if (auto problem = parseQuery(target, result.query)) return tl::unexpected(*std::move(problem));
  return result;
}

Request inOriginForm(Request request) {
  constexpr std::string_view kScheme = "http://";
  std::string_view target = request.target;
  if (common::lowerCase(target.substr(0, kScheme.size())) != kScheme) return request;
  target.remove_prefix(kScheme.size());
  const std::string_view authority = target.substr(0, target.find_first_of("/?"));
  target.remove_prefix(authority.size());
  request.host = authority;
  request.target = (target.starts_with('/') ? "" : "/") + std::string(target);
  return request;
}

std::optional<Authority> parseAuthority(std::string_view text) {
  const bool bracketed = text.starts_with('[');
  const std::size_t end = bracketed ? text.find(']') : text.find(':');
  if (bracketed && end == std::string_view::npos) return std::nullopt;
  const std::string_view rest = end == std::string_view::npos ? "" : text.substr(bracketed ? end + 1 : end);
  const auto port = portIn(rest);
  const auto host = bracketed ? shortestForm(text.substr(1, end - 1)) : nameIn(text.substr(0, end));
  if (!host || !port) return std::nullopt;
  return Authority{*host, *port == 0 ? std::nullopt : std::optional(*port)};
}

bool isAddressLiteral(std::string_view host) {
  if (host.find(':') != std::string_view::npos) return true;
  int parts = 0, digits = 0;
  for (const char c : host) {
    if (c == '.') {
      if (digits == 0) return false;
      ++parts;
      digits = 0;
    } else if (c < '0' || c > '9' || ++digits > 3) {
      return false;
    }
  }
  return parts == 3 && digits > 0;
}

}  // namespace swiftlet::web
