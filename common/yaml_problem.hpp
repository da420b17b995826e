// Reading YAML, and what people who wrote it by hand are told when it cannot be read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/error.hpp"

namespace YAML {
class Node;
}

namespace swiftlet::common {

/// The only document of a text; null for an empty one. Throws InputError with place, cause and remedy for a text that
/// is not YAML, and for what the library would take in silence: a quote that is never closed, a second document.
YAML::Node loadYaml(const std::string& text, const std::string& file);

/// How to write a number that was written as `0,5`, `0.5 m`, `90°`, `1'000` or `1#comment`; empty if that is unknown.
/// The unit is compared with the end of the key's name, `range_m`; a key may have none, and an option of the command
/// line is no key: "". Another unit is never dropped, because the number would mean another value.
std::string numberHint(std::string_view key, std::string_view written, bool whole = false);

/// "line 3 has a no-break space (U+00A0) in column 5: write a plain blank": of the first character of a line, outside
/// of comments, that looks like another or like nothing; empty without one. Lines and columns (in bytes) count from 1.
std::string lookalikeHint(const std::vector<std::string_view>& lines, int line);
std::vector<std::string_view> linesOf(std::string_view text);

/// "put a blank behind the colon: `laser: utm_30lx`" of `laser:utm_30lx`, and likewise for `laser = utm_30lx`; empty
/// for other texts.
std::string keyHint(std::string_view written);

}  // namespace swiftlet::common
