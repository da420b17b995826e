// "x;y;z" as options take it.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace swiftlet::apps {

/// Three finite numbers with semicolons between them; none for any other text.
std::optional<std::array<double, 3>> threeNumbers(const std::string& text);

}  // namespace swiftlet::apps
