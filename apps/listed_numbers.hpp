// "x;y;z" as options take it.
#pragma once

#include <string>
#include <vector>

namespace swiftlet::apps {

/// The finite numbers of a text with semicolons between them; empty for any other text. A decimal comma is no number.
std::vector<double> listedNumbers(const std::string& text);

}  // namespace swiftlet::apps
