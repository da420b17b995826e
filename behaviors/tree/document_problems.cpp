#include "behaviors/tree/document_problems.hpp"

#include <utility>

#include "behaviors/tree/characters.hpp"
#include "behaviors/tree/elements.hpp"

namespace swiftlet::tree {

Problem strayText(const Document& document, const XmlElement& element) {
  const std::string& text = document.source.text();
  const std::size_t at = *element.text_offset;
  if (auto problem = strayCommentEnd(document.source, at)) return *problem;
  const std::string misleads = misleadingCharacterIn(std::string_view(text).substr(at, characterLength(text, at)));
  return {document.source.locate(at), element.name,
          Message("tree.stray-text", "text is not expected here{}{}", misleads.empty() ? "" : "; it begins with ",
                  misleads),
          "a comment is written as <!-- text -->"};
}

Problem missingAttribute(const Document& document, const XmlElement& element, std::string_view attribute,
                         std::string hint) {
  return {document.at(element), element.name,
          Message("tree.attribute-missing", "the attribute `{}` is missing", attribute), std::move(hint)};
}

Problem unknownAttribute(const Document& document, const XmlElement& element, const std::string& attribute,
                         std::string hint) {
  return {document.at(element, attribute), typeNameOf(element),
          Message("tree.unknown-attribute", "unknown attribute `{}`", attribute), std::move(hint)};
}

Problem unknownTree(const Document& document, const XmlElement& element, std::string_view attribute, std::string hint) {
  return {document.at(element, attribute), element.name,
          Message("tree.unknown-tree", "there is no <BehaviorTree ID=\"{}\">", *element.attribute(attribute)),
          std::move(hint)};
}

Problem notRoot(const Document& document, std::string_view attributes) {
  return {document.at(document.root), document.root.name,
          Message("tree.outermost-element", "the outermost element must be <root{}>", attributes)};
}

Problem otherFormat(const Document& document, const std::string& expected, std::string hint) {
  return {document.at(document.root, "BTCPP_format"), "root",
          Message("tree.other-format", "BTCPP_format=\"{}\", expected \"{}\"", *document.root.attribute("BTCPP_format"),
                  expected),
          std::move(hint)};
}

}  // namespace swiftlet::tree
