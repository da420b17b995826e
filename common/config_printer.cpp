#include <fmt/format.h>

#include "common/config.hpp"
#include "common/config_text.hpp"

namespace swiftlet::common::config {
namespace {

/// The sentence of a setting, followed by its bounds.
std::string comment(std::string_view sentence, const Bounds& bounds) {
  std::string range = bounds.text();
  if (range.empty()) return std::string(sentence);
  range = bounds.high < kFinite.high ? "From " + range : std::string(1, 'A') + range.substr(1);
  return fmt::format("{} {}.", sentence, range);
}

}  // namespace

void YamlPrinter::line(std::string_view name, const std::string& value, std::string_view sentence) {
  std::string indent(static_cast<std::size_t>(2 * depth_), ' ');
  if (item_starts_) indent.replace(indent.size() - 2, 2, "- ");
  item_starts_ = false;
  text_ += fmt::format("{}{}:{}{}", indent, name, value.empty() ? "" : " ", value);
  if (comments_ == Comments::kYes && !sentence.empty()) text_ += fmt::format("  # {}", sentence);
  text_ += '\n';
}

void YamlPrinter::operator()(std::string_view name, double& value, const Bounds& bounds, std::string_view sentence) {
  line(name, yamlOf(value), comment(sentence, bounds));
}
void YamlPrinter::operator()(std::string_view name, int& value, const Bounds& bounds, std::string_view sentence) {
  line(name, std::to_string(value), comment(sentence, bounds));
}
void YamlPrinter::operator()(std::string_view name, bool& value, std::string_view sentence) {
  line(name, yamlOf(value), sentence);
}
void YamlPrinter::operator()(std::string_view name, std::string& value, std::string_view sentence) {
  line(name, yamlOf(value), sentence);
}
void YamlPrinter::operator()(std::string_view name, std::vector<double>& value, const Bounds& bounds,
                             std::string_view sentence) {
  line(name, yamlOf(value), comment(sentence, bounds));
}
void YamlPrinter::operator()(std::string_view name, std::vector<std::string>& value, std::string_view sentence) {
  line(name, yamlOf(value), sentence);
}

void YamlPrinter::choice(std::string_view name, int& value, const std::vector<std::string>& words,
                         std::string_view sentence) {
  line(name, words.at(static_cast<std::size_t>(value)), fmt::format("{} One of: {}.", sentence, listed(words)));
}

bool YamlPrinter::beginSection(std::string_view name, std::string_view sentence) {
  line(name, "", sentence);
  ++depth_;
  return true;
}

void YamlPrinter::endSection(std::vector<Problem>) { --depth_; }

std::optional<int> YamlPrinter::beginList(std::string_view name, int count, std::string_view sentence) {
  line(name, count == 0 ? "[]" : "", sentence);
  ++depth_;
  return std::nullopt;
}

void YamlPrinter::beginItem(int) {
  ++depth_;
  item_starts_ = true;
}

void YamlPrinter::endList() { --depth_; }

}  // namespace swiftlet::common::config
