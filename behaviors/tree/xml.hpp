// XML as elements with the place each stands at. Reads UTF-8 by expat; no DOCTYPE, hence no entities but the five of
// XML.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/problem.hpp"

namespace swiftlet::tree {

struct XmlAttribute {
  std::string name;
  std::string value;
};

struct XmlElement {
  std::string name;
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;
  std::size_t offset = 0;                  ///< Of its "<", in bytes.
  std::optional<std::size_t> text_offset;  ///< Of the first text directly in it that is not blank.

  const std::string* attribute(std::string_view attribute_name) const;
};

/// A file's text, in which offsets are turned into lines and columns when a message needs them.
class SourceText {
 public:
  SourceText(std::string file, std::string text) : file_(std::move(file)), text_(std::move(text)) {}

  const std::string& file() const { return file_; }
  const std::string& text() const { return text_; }
  Location locate(std::size_t offset) const;
  /// Of an attribute's name within the tag that starts at `element_offset`; of the tag when it has no such attribute.
  Location locate(std::size_t element_offset, std::string_view attribute) const;

 private:
  std::string file_;
  std::string text_;
};

struct XmlResult {
  std::optional<XmlElement> root;
  std::optional<Problem> problem;  ///< There when `root` is not.
};

/// `max_depth`: elements within elements.
XmlResult parseXml(const SourceText& source, int max_depth);

}  // namespace swiftlet::tree
