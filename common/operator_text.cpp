#include "common/operator_text.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace swiftlet::common {
namespace {

bool belongsToPath(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return std::isalnum(byte) != 0 || byte >= 0x80 || std::string_view("_-.~/+").find(c) != std::string_view::npos;
}

/// "map.yaml" and "events.jsonl", not "s2" or "1.5".
bool namesFile(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot != std::string_view::npos && dot + 1 < name.size() &&
         std::isalpha(static_cast<unsigned char>(name[dot + 1])) != 0;
}

/// Units such as m/s are no paths, and neither is what follows the scheme of an address.
bool isPath(std::string_view word) {
  if (word.starts_with("//") || word.find('/') == std::string_view::npos) return false;
  const bool rooted =
      word.starts_with("/") || word.starts_with("./") || word.starts_with("../") || word.starts_with("~/");
  return (rooted && word.size() > 3) || namesFile(word.substr(word.rfind('/') + 1));
}

std::string_view fileOf(std::string_view path) {
  while (path.size() > 1 && path.ends_with('/')) path.remove_suffix(1);
  return path.substr(path.rfind('/') + 1);
}

}  // namespace

std::string withoutFolders(std::string_view text) {
  std::string short_text;
  while (!text.empty()) {
    const auto end = std::find_if_not(text.begin(), text.end(), belongsToPath);
    const std::string_view word = text.substr(0, static_cast<std::size_t>(end - text.begin()));
    short_text += isPath(word) ? fileOf(word) : word;
    text.remove_prefix(word.size());
    if (text.empty()) break;
    short_text += text.front();
    text.remove_prefix(1);
  }
  return short_text;
}

std::string forOperator(const Problem& problem) {
  Problem told = problem;
  // A hint that names an option helps only where the program is started.
  if (told.hint.find("--") != std::string::npos) told.hint.clear();
  return withoutFolders(toString(told));
}

std::string forOperator(const InputError& error) {
  const std::size_t more = error.problems().size() - 1;
  return forOperator(error.problems().front()) + (more > 0 ? fmt::format(" (and {} more)", more) : "");
}

}  // namespace swiftlet::common
