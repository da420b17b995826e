// One file of a tree: its text and its elements.
#pragma once

#include <string_view>

#include "behaviors/tree/xml.hpp"

namespace swiftlet::tree {

struct Document {
  SourceText source;
  XmlElement root;
  bool is_elsewhere = false;  ///< Read for one of its trees, without an <include>.

  Location at(const XmlElement& element) const { return source.locate(element.offset); }
  Location at(const XmlElement& element, std::string_view attribute) const {
    return source.locate(element.offset, attribute);
  }
};

}  // namespace swiftlet::tree
