// A table of figures for people: one value that prints as text in a terminal and as rows in a report.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace swiftlet::common {

enum class Mark { kNone, kGood, kBad };

struct TableCell {
  std::string text;
  Mark mark = Mark::kNone;
  std::string link = {};  ///< Path relative to the report that shows it; may be empty.
};

struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<TableCell>> rows;  ///< Each as long as `columns`.
};

/// Whether every cell of a column that is not empty begins like a number. Such columns are aligned to the right.
bool isNumeric(const Table& table, std::size_t column);

/// Text with columns aligned by spaces, without marks and links.
std::string toText(const Table& table);

}  // namespace swiftlet::common
