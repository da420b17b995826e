// XML as elements with their positions. Reads UTF-8 by expat. A DOCTYPE is refused, so that there are no entities but
// the five of XML.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/problem.hpp"

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

/// Where an attribute stands in its file, as offsets: of its name, and of the first and last quote of its value.
struct AttributeSpan {
  std::size_t name = 0, name_end = 0;
  std::size_t opening_quote = 0, closing_quote = 0;
};

/// The text of a file, which converts offsets to lines and columns for messages.
class SourceText {
 public:
  SourceText(std::string file, std::string text) : file_(std::move(file)), text_(std::move(text)) {}

  const std::string& file() const { return file_; }
  const std::string& text() const { return text_; }
  Location locate(std::size_t offset) const;
  /// Offset of an attribute's name within the tag that starts at `element_offset`; that of the tag if it has no such
  /// attribute.
  Location locate(std::size_t element_offset, std::string_view attribute) const;
  /// Nothing if the tag that starts at `element_offset` has no such attribute.
  std::optional<AttributeSpan> spanOf(std::size_t element_offset, std::string_view attribute) const;
  /// Offset behind the ">" of the tag that starts at `tag_offset`.
  std::size_t endOfTag(std::size_t tag_offset) const;

 private:
  std::string file_;
  std::string text_;
};

struct XmlResult {
  std::optional<XmlElement> root;
  std::optional<Problem> problem;  ///< Present if `root` is not.
};

/// `max_depth` limits elements within elements.
XmlResult parseXml(const SourceText& source, int max_depth);

}  // namespace swiftlet::tree
