// What people read of an envelope: the report, and the part of a Markdown page that the program writes.
#pragma once

#include <filesystem>
#include <string>

#include "evaluation/envelope_results.hpp"

namespace swiftlet::apps {

/// One <svg> element.
std::string envelopePicture(const evaluation::EnvelopeResults& results);

/// The text of report.html.
std::string envelopeReport(const evaluation::EnvelopeResults& results, const std::string& started);

/// The lines of a page between which the program writes; the rest of the page stays as it is.
inline constexpr const char* kPageBegin = "<!-- written by `swiftlet trial --envelope --write` -->";
inline constexpr const char* kPageEnd = "<!-- end of what is written -->";

/// Throws common::InputError if the page is not there or lacks one of these lines.
void checkPage(const std::filesystem::path& page);

/// Writes table and picture into the page; the picture is images/NAME.svg beside the page NAME.md. Throws
/// common::InputError.
void writePage(const std::filesystem::path& page, const evaluation::EnvelopeResults& results);

}  // namespace swiftlet::apps
