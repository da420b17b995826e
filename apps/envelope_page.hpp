// What people read of an envelope: the report, and the part of a Markdown page that the program writes.
#pragma once

#include <filesystem>
#include <string>

#include "apps/markdown_page.hpp"
#include "evaluation/envelope_results.hpp"

namespace swiftlet::apps {

/// One <svg> element.
std::string envelopePicture(const evaluation::EnvelopeResults& results);

/// The text of report.html.
std::string envelopeReport(const evaluation::EnvelopeResults& results, const std::string& started);

/// The lines of the page between which table and picture are written.
inline constexpr PageMarks kEnvelopeMarks{"<!-- written by `swiftlet trial --envelope --write` -->",
                                          "<!-- end of what is written -->", "--write"};

/// Writes table and picture into the page; the picture is images/NAME.svg beside the page NAME.md. Throws
/// common::InputError.
void writePage(const std::filesystem::path& page, const evaluation::EnvelopeResults& results);

}  // namespace swiftlet::apps
