#include "common/table.hpp"

#include <algorithm>

#include "common/check.hpp"

namespace swiftlet::common {
namespace {

/// Characters, not bytes, of UTF-8 text.
std::size_t widthOf(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

void append(std::string& line, const std::string& text, std::size_t column, std::size_t width) {
  const std::string padding(width - widthOf(text), ' ');
  if (column > 0) line += "  ";
  line += column == 0 ? text + padding : padding + text;
}

}  // namespace

std::string toText(const Table& table) {
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) widths.push_back(widthOf(column));
  for (const auto& row : table.rows) {
    SWIFTLET_CHECK(row.size() == widths.size(), row.size(), widths.size());
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], widthOf(row[i].text));
  }

  std::string text = table.title.empty() ? "" : table.title + "\n";
  std::string head;
  for (std::size_t i = 0; i < widths.size(); ++i) append(head, table.columns[i], i, widths[i]);
  text += head + "\n" + std::string(widthOf(head), '-') + "\n";
  for (const auto& row : table.rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) append(line, row[i].text, i, widths[i]);
    text += line + "\n";
  }
  return text;
}

}  // namespace swiftlet::common
