// The text of a tree file, with the lines and columns of its bytes and the places of its attributes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "behaviors/tree/encoding.hpp"
#include "behaviors/tree/problem.hpp"

namespace swiftlet::tree {

/// Where an attribute stands in its file, as offsets: of its name, and of the first and last quote of its value.
struct AttributeSpan {
  std::size_t name = 0, name_end = 0;
  std::size_t opening_quote = 0, closing_quote = 0;
};

/// For one thread at a time.
class SourceText {
 public:
  /// The bytes may be of any encoding (encoding.hpp); text() and all offsets are those of UTF-8.
  SourceText(std::string file, std::string bytes) : file_(std::move(file)), text_(inUtf8(std::move(bytes))) {}

  const std::string& file() const { return file_; }
  const std::string& text() const { return text_; }
  /// A line ends with \n, \r\n or \r.
  Location locate(std::size_t offset) const;
  /// Offset of an attribute's name within the tag that starts at `element_offset`; that of the tag if it has no such
  /// attribute.
  Location locate(std::size_t element_offset, std::string_view attribute) const;
  /// Nothing if the tag that starts at `element_offset` has no such attribute.
  std::optional<AttributeSpan> spanOf(std::size_t element_offset, std::string_view attribute) const;
  /// Of every attribute of the tag that starts at `element_offset`, in its order.
  std::vector<AttributeSpan> spansOf(std::size_t element_offset) const;
  /// Offset behind the ">" of the tag that starts at `tag_offset`.
  std::size_t endOfTag(std::size_t tag_offset) const;

 private:
  /// A byte whose place is known; other places are counted from the last mark before them.
  struct Mark {
    std::size_t offset = 0;
    int line = 1, column = 1;
  };
  std::vector<Mark> marked() const;
  /// The attribute behind the blanks at `from`, which is the end of the tag's name or of another attribute.
  std::optional<AttributeSpan> nextSpan(std::size_t from) const;
  std::size_t endOfTagName(std::size_t element_offset) const;

  std::string file_;
  std::string text_;
  mutable std::vector<Mark> marks_;  ///< Made when a place is asked for the first time: few files have a problem.
};

}  // namespace swiftlet::tree
