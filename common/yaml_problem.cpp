#include "common/yaml_problem.hpp"

#include <algorithm>

namespace swiftlet::common {
namespace {

/// Whether the blanks at the beginning of the line have a tab among them. Lines are counted from 1.
bool isIndentedByTab(std::string_view text, int line) {
  for (int i = 1; i < line; ++i) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return false;
    text.remove_prefix(end + 1);
  }
  const std::string_view indent = text.substr(0, std::min(text.find_first_not_of(" \t"), text.size()));
  return indent.find('\t') != std::string_view::npos;
}

}  // namespace

Problem notYaml(std::string_view text, const SourceLocation& location, const std::string& message) {
  const bool tab =
      isIndentedByTab(text, location.line) || (location.line > 1 && isIndentedByTab(text, location.line - 1));
  return {location, "", "not YAML: " + message, tab ? "YAML is indented by spaces, not tabs" : ""};
}

}  // namespace swiftlet::common
