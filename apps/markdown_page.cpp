#include "apps/markdown_page.hpp"

#include <utility>

#include <fmt/format.h>

#include "apps/output_file.hpp"
#include "common/error.hpp"
#include "common/read_bytes.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/required.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

/// Where the text between the lines begins and ends in that of the page.
std::pair<std::size_t, std::size_t> placeIn(const std::string& text, const fs::path& page, const PageMarks& marks) {
  const std::size_t begin = text.find(marks.begin);
  const std::size_t end = begin == std::string::npos ? begin : text.find(marks.end, begin);
  if (end == std::string::npos)
    throw common::InputError({page.string()}, std::string(marks.option),
                             common::Message("page.no-place", "the page has no place for the results"),
                             fmt::format("it needs the lines `{}` and `{}`", marks.begin, marks.end));
  return {begin + marks.begin.size() + 1, end};
}

std::string readPage(const fs::path& page) { return common::readBytes(page.string(), std::size_t{1} << 20); }

}  // namespace

std::string markdownOf(const common::Table& table) {
  const auto row = [](const auto& cells, auto&& textOf) {
    std::string line = "|";
    for (const auto& cell : cells) {
      std::string text = textOf(cell);
      for (std::size_t bar = text.find('|'); bar != std::string::npos; bar = text.find('|', bar + 2))
        text.replace(bar, 1, "\\|");
      line += " " + text + " |";
    }
    return line + "\n";
  };
  std::string text = row(table.columns, [](const std::string& column) { return column; });
  text += row(table.columns, [](const std::string&) { return std::string("---"); });
  for (const auto& cells : table.rows) text += row(cells, [](const common::TableCell& cell) { return cell.text; });
  return text;
}

void checkPage(const fs::path& page, const PageMarks& marks) {
  placeIn(readPage(page), page, marks);
  requireWritable(page, std::string(marks.option));
}

void writeBetween(const fs::path& page, const PageMarks& marks, const std::string& text) {
  std::string whole = readPage(page);
  const auto [begin, end] = placeIn(whole, page, marks);
  whole.replace(begin, end - begin, text);
  required(interfaces::writeAtomically(page, whole));
}

}  // namespace swiftlet::apps
