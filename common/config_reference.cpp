#include "common/config_reference.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/config_text.hpp"

namespace swiftlet::common::config {

void ReferencePrinter::open(std::string path, std::string sentence) {
  open_.push_back({std::move(path), std::move(sentence), {}, {}});
}

std::string ReferencePrinter::closed() {
  const Section section = std::move(open_.back());
  open_.pop_back();
  std::string text = "\n" + section.sentence + "\n";
  if (!section.rows.empty()) text += "\n| setting | default | bounds | |\n| --- | --- | --- | --- |\n" + section.rows;
  return text + section.sections;
}

/// The path of a setting, without the chapter's title.
std::string ReferencePrinter::pathOf(std::string_view name) const {
  return open_.size() <= 1 ? std::string(name) : fmt::format("{}.{}", open_.back().path, name);
}

void ReferencePrinter::row(std::string_view name, const std::string& value, const std::string& bounds,
                           std::string_view sentence) {
  open_.back().rows += fmt::format("| `{}` | `{}` | {} | {} |\n", name, value, bounds, sentence);
}

void ReferencePrinter::operator()(std::string_view name, double& value, const Bounds& bounds,
                                  std::string_view sentence) {
  row(name, yamlOf(value), bounds.text(), sentence);
}
void ReferencePrinter::operator()(std::string_view name, int& value, const Bounds& bounds, std::string_view sentence) {
  row(name, std::to_string(value), bounds.text(), sentence);
}
void ReferencePrinter::operator()(std::string_view name, bool& value, std::string_view sentence) {
  row(name, yamlOf(value), "true, false", sentence);
}
void ReferencePrinter::operator()(std::string_view name, std::string& value, std::string_view sentence) {
  row(name, yamlOf(value), "text", sentence);
}
void ReferencePrinter::operator()(std::string_view name, std::vector<double>& value, const Bounds& bounds,
                                  std::string_view sentence) {
  const std::string each = bounds.text();
  row(name, yamlOf(value), each.empty() ? "list" : "list, each " + each, sentence);
}
void ReferencePrinter::operator()(std::string_view name, std::vector<std::string>& value, std::string_view sentence) {
  row(name, yamlOf(value), "list of texts", sentence);
}

void ReferencePrinter::choice(std::string_view name, int& value, const std::vector<std::string>& words,
                              std::string_view sentence) {
  row(name, words.at(static_cast<std::size_t>(value)), listed(words), sentence);
}

bool ReferencePrinter::beginSection(std::string_view name, std::string_view sentence) {
  open(pathOf(name), std::string(sentence));
  return true;
}

void ReferencePrinter::endSection(std::vector<Problem>) {
  const std::string path = open_.back().path;
  const std::string text = closed();
  open_.back().sections += fmt::format("\n### `{}`\n{}", path, text);
}

std::optional<int> ReferencePrinter::beginList(std::string_view name, int, std::string_view sentence) {
  open(pathOf(name) + "[]", std::string(sentence));
  return 1;
}

/// A list is one section, whose rows are the settings of an item.
void ReferencePrinter::beginItem(int) {}
void ReferencePrinter::endList() {}

}  // namespace swiftlet::common::config
