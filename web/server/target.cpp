#include "web/server/target.hpp"

#include <algorithm>
#include <cctype>

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

bool parseQuery(std::string_view text, std::map<std::string, std::string>& query) {
  while (!text.empty()) {
    const std::string_view pair = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(pair.size() + 1, text.size()));
    if (pair.empty()) continue;
    const std::size_t equals = pair.find('=');
    const auto key = decoded(pair.substr(0, equals), true);
    const auto value = equals == std::string_view::npos ? std::string() : decoded(pair.substr(equals + 1), true);
    if (!key || !value || !query.emplace(*key, *value).second) return false;
  }
  return true;
}

}  // namespace

std::optional<Target> parseTarget(std::string_view target) {
  if (target.empty() || target.front() != '/') return std::nullopt;
  const std::size_t question = target.find('?');
  const auto path = decoded(target.substr(0, question), false);
  if (!path || climbs(*path)) return std::nullopt;
  Target result{*path, {}};
  if (question != std::string_view::npos && !parseQuery(target.substr(question + 1), result.query)) return std::nullopt;
  return result;
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
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
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
