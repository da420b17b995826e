// The tags of an SDF file, read as leniently as libsdformat reads them (it parses with TinyXML-2): comments may hold
// `--`, text may hold a bare `&`, any encoding may be declared. Expat, a strict parser, refuses files that Gazebo
// opens.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "common/error.hpp"

namespace swiftlet::simulation {

/// Where an offset in a text is.
common::SourceLocation locationIn(const std::string& file, std::string_view text, std::size_t offset);

/// An element, by its place in the text.
struct SdfTag {
  std::string_view name;
  std::string_view attributes;  ///< As written: `name="a" pose='0 0'`.
  std::size_t begin = 0;        ///< Of `<name`.
  std::size_t content = 0;      ///< Behind the `>` of the opening tag.
  std::size_t content_end = 0;  ///< Of `</name>`; equals `content` in an element such as `<name/>`.
  std::size_t end = 0;          ///< Behind the element.
  int parent = -1;              ///< Index of the element around it; -1: it is the root.
};

/// All elements in the order of their opening tags; their views are into `text`. The error is the first place where the
/// text is not XML, with the names of the tags that do not match.
tl::expected<std::vector<SdfTag>, common::Problem> readTags(const std::string& file, std::string_view text);

/// The value of an attribute, without quotes, as it stands in the text.
std::optional<std::string_view> attributeOf(const SdfTag& tag, std::string_view name);

/// The text that libsdformat takes for that of an element: up to the first element or comment behind its beginning,
/// where comments are left out. Without white space around it; the five entities of XML are replaced, and
/// `<![CDATA[...]]>` is its content.
std::string textOf(const SdfTag& tag, std::string_view text);

}  // namespace swiftlet::simulation
