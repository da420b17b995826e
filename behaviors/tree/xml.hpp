// XML as elements with their positions. Reads by expat. A DOCTYPE is refused, so that there are no entities but
// the five of XML.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/problem.hpp"
#include "behaviors/tree/source_text.hpp"

namespace swiftlet::tree {

class Script;

struct XmlAttribute {
  std::string name;
  std::string value;
  /// The script that the value is, if it is one: noted by the checker, taken by the builder. Reading the file leaves it
  /// null.
  mutable Script* script = nullptr;
};

struct XmlElement {
  std::string name;
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;
  std::size_t offset = 0;                   ///< Offset of its "<", in bytes.
  std::optional<std::size_t> close_offset;  ///< Offset of the "<" of its closing tag; nothing for <Element/>.
  std::optional<std::size_t> text_offset;   ///< Offset of its first text that is not blank, children excluded.

  /// Null if it has no such attribute.
  const XmlAttribute* find(std::string_view attribute_name) const;
  /// Value of the attribute; null if there is no such attribute.
  const std::string* attribute(std::string_view attribute_name) const;
};

struct XmlResult {
  std::optional<XmlElement> root;
  std::optional<Problem> problem;  ///< Present if `root` is not.
  /// What XML does not allow, as offsets: the first `--` within each comment, and of a lenient reading `<` and `&`
  /// that stand for themselves, the first of each value.
  std::vector<std::size_t> unescaped;
};

/// Of a file that is larger than this.
Message fileTooLarge(const std::string& file, std::size_t most_bytes);
/// Of a `-->` in the text that begins at `from` and ends at the next tag: a comment before it has ended already.
std::optional<Problem> strayCommentEnd(const SourceText& source, std::size_t from);

/// `max_depth` limits elements within elements, below <root> and <BehaviorTree>. Comments are taken as tinyxml2 takes
/// them, leniently also `<` and `&` in the values of attributes (escaped_text.hpp); else those are a problem.
XmlResult parseXml(const SourceText& source, int max_depth, bool lenient = false);

}  // namespace swiftlet::tree
