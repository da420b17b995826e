// Pages in Markdown of which a command writes a part: what is between two lines, and the rest stays as it is.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/table.hpp"

namespace swiftlet::apps {

/// The table without its title.
std::string markdownOf(const common::Table& table);

/// The lines between which a command writes, and its option for the page.
struct PageMarks {
  std::string_view begin, end, option;
};

/// Throws common::InputError if the page is not there, lacks one of the lines or cannot be written. Call it before the
/// work.
void checkPage(const std::filesystem::path& page, const PageMarks& marks);

/// Writes the text between the lines. Throws common::InputError.
void writeBetween(const std::filesystem::path& page, const PageMarks& marks, const std::string& text);

}  // namespace swiftlet::apps
