#include "web/server/target.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "web/server/refusal.hpp"

namespace swiftlet::web {
namespace {

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

char lowerCase(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

std::string malformed(std::string_view target) { return fmt::format("the address {} is malformed", shown(target)); }

/// What is wrong with it; empty if nothing is.
std::string parseQuery(std::string_view target, std::map<std::string, std::string>& query) {
  std::string_view text = target.substr(target.find('?') + 1);
  while (!text.empty()) {
    const std::string_view pair = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(pair.size() + 1, text.size()));
    if (pair.empty()) continue;
    const std::size_t equals = pair.find('=');
    const auto key = decoded(pair.substr(0, equals), true);
    const auto value = equals == std::string_view::npos ? std::string() : decoded(pair.substr(equals + 1), true);
    if (!key || !value) return malformed(target);
    if (!query.emplace(*key, *value).second) return fmt::format("{} is given twice", shown(*key));
  }
  return {};
}

}  // namespace

tl::expected<Target, std::string> parseTarget(std::string_view target) {
  if (target.empty() || target.front() != '/') return tl::unexpected(malformed(target));
  const std::size_t question = target.find('?');
  const auto path = decoded(target.substr(0, question), false);
  if (!path || climbs(*path)) return tl::unexpected(malformed(target));
  Target result{*path, {}};
  if (question == std::string_view::npos) return result;
  if (std::string problem = parseQuery(target, result.query); !problem.empty())
    return tl::unexpected(std::move(problem));
  return result;
}

std::optional<AbsoluteTarget> absoluteTarget(std::string_view target) {
  constexpr std::string_view kScheme = "http://";
  const std::string_view begin = target.substr(0, kScheme.size());
  if (!std::equal(begin.begin(), begin.end(), kScheme.begin(), kScheme.end(),
                  [](char given, char wanted) { return lowerCase(given) == wanted; }))
    return std::nullopt;
  target.remove_prefix(kScheme.size());
  const std::string_view authority = target.substr(0, target.find_first_of("/?"));
  target.remove_prefix(authority.size());
  return AbsoluteTarget{std::string(authority), (target.starts_with('/') ? "" : "/") + std::string(target)};
}

std::optional<std::string> hostName(std::string_view host_header) {
  std::string_view name = host_header, port;
  if (!name.empty() && name.front() == '[') {
    const std::size_t close = name.find(']');
    if (close == std::string_view::npos) return std::nullopt;
    port = name.substr(close + 1);
    name = name.substr(1, close - 1);
  } else if (const std::size_t colon = name.find(':'); colon != std::string_view::npos) {
    port = name.substr(colon);
    name = name.substr(0, colon);
  }
  const auto digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  if (!port.empty() && (port.front() != ':' || !std::all_of(port.begin() + 1, port.end(), digit))) return std::nullopt;
  const auto sound = [](unsigned char c) { return std::isalnum(c) || c == '.' || c == '-' || c == ':' || c == '_'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), sound)) return std::nullopt;
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(), lowerCase);
  return lower;
}

bool isAddressLiteral(std::string_view host_name) {
  if (host_name.find(':') != std::string_view::npos)
    return std::all_of(host_name.begin(), host_name.end(),
                       [](char c) { return hexDigit(c) >= 0 || c == ':' || c == '.'; });
  int parts = 0, digits = 0;
  for (const char c : host_name) {
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
