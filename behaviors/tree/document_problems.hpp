// Problems that several readers of documents find.
#pragma once

#include <string>
#include <string_view>

#include "behaviors/tree/document.hpp"
#include "behaviors/tree/problem.hpp"

namespace swiftlet::tree {

/// Of an element that holds text.
Problem strayText(const Document& document, const XmlElement& element);
/// Of an element that lacks the attribute.
Problem missingAttribute(const Document& document, const XmlElement& element, std::string_view attribute,
                         std::string hint = {});
/// Of an element that has the attribute.
Problem unknownAttribute(const Document& document, const XmlElement& element, const std::string& attribute,
                         std::string hint);
/// Of an element whose attribute is the ID of no tree.
Problem unknownTree(const Document& document, const XmlElement& element, std::string_view attribute, std::string hint);
/// Of an outermost element that is none with these attributes.
Problem notRoot(const Document& document, std::string_view attributes);
/// Of a file of another version than the expected one.
Problem otherFormat(const Document& document, const std::string& expected, std::string hint = {});

}  // namespace swiftlet::tree
