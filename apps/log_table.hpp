// The table of all recorded logs, as Markdown, and the page that has it between two markers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/log_run.hpp"

namespace swiftlet::apps {

/// A row for each run, a table that counts for each log the maps that are right or wrong and trusted or doubted, and a
/// line with their sums. `outcomes` is as long as `runs`, in which the runs of a log follow one another.
std::string logTable(const std::vector<LogRun>& runs, const std::vector<LogOutcome>& outcomes);

/// Throws common::InputError if the page exists and has no place for the table, or it cannot be written. Call it
/// before the work.
void checkLogPage(const std::filesystem::path& page);

/// Puts the table between two lines of the page, whose other text stays; makes the page if it is not there. Throws
/// common::InputError.
void writeLogPage(const std::filesystem::path& page, const std::string& table);

}  // namespace swiftlet::apps
