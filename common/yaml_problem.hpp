// Reading YAML, and the messages for people who wrote it by hand, when it cannot be read.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.hpp"

namespace YAML {
class Node;
}

namespace swiftlet::common {

/// A file is refused above that.
inline constexpr std::size_t kMostYamlBytes = std::size_t{8} << 20;

/// The text of a file without a byte order mark, as UTF-8 if it was UTF-16, with lines that end with "\n" or "\r\n".
/// The places that loadYaml() and others tell are places in it.
std::string yamlText(std::string bytes);

/// The only document of a text that yamlText() made; null for an empty one. Throws InputError with place, cause and
/// remedy for a text that is not YAML, and for what the library would take in silence: a quote that is never closed, a
/// second document.
YAML::Node loadYaml(const std::string& text, const std::string& file);

/// "line 3 has a no-break space (U+00A0) in column 5: write a plain blank": of the first character of a line, outside
/// of comments, that looks like another or like nothing; empty without one. Lines and columns (in bytes) count from 1.
std::string lookalikeHint(const std::vector<std::string_view>& lines, int line);
std::vector<std::string_view> linesOf(std::string_view text);

/// "put a blank behind the colon: `laser: utm_30lx`" of `laser:utm_30lx`, and likewise for `laser = utm_30lx`; empty
/// for other texts.
std::string keyHint(std::string_view written);

}  // namespace swiftlet::common
