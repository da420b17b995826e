#include "common/table.hpp"

#include <algorithm>

#include "common/check.hpp"
#include "common/printable.hpp"

namespace swiftlet::common {
namespace {

/// Number of characters, not bytes, of UTF-8 text.
std::size_t widthOf(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

struct Column {
  std::size_t width = 0;
  bool right = false;
};

std::string joined(const std::vector<Column>& columns, const std::vector<std::string>& texts) {
  std::string line;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string padding(columns[i].width - widthOf(texts[i]), ' ');
    if (i > 0) line += "  ";
    line += columns[i].right ? padding + texts[i] : texts[i] + padding;
  }
  return line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

}  // namespace

bool isNumeric(const Table& table, std::size_t column) {
  return std::all_of(table.rows.begin(), table.rows.end(), [&](const std::vector<TableCell>& row) {
    const std::string& text = row[column].text;
    return text.empty() || text[0] == '-' || (text[0] >= '0' && text[0] <= '9');
  });
}

std::string toText(const Table& given) {
  Table table = given;
  for (std::vector<TableCell>& row : table.rows)
    for (TableCell& cell : row) cell.text = printable(cell.text);
  std::vector<Column> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    columns.push_back({widthOf(table.columns[i]), isNumeric(table, i)});
    for (const auto& row : table.rows) {
      SWIFTLET_CHECK(row.size() == table.columns.size(), row.size(), table.columns.size());
      columns.back().width = std::max(columns.back().width, widthOf(row[i].text));
    }
  }

  std::size_t total = 0;
  for (const Column& column : columns) total += column.width + (total > 0 ? 2 : 0);
  std::string text = table.title.empty() ? "" : printableLines(table.title) + "\n";
  text += joined(columns, table.columns) + std::string(total, '-') + "\n";
  for (const auto& row : table.rows) {
    std::vector<std::string> texts;
    for (const TableCell& cell : row) texts.push_back(cell.text);
    text += joined(columns, texts);
  }
  return text;
}

}  // namespace swiftlet::common
