// How the elements below <BehaviorTree> are read: their node type, which attributes are ports, and what an attribute
// binds.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/registry.hpp"
#include "behaviors/tree/xml.hpp"

namespace swiftlet::tree {

/// <Action>, <Condition>, <Control>, <Decorator>: the type is in the attribute ID.
std::optional<NodeKind> explicitKind(std::string_view tag);
inline bool isSubTree(const XmlElement& element) { return element.name == "SubTree"; }
/// Adds the trees that an element and those below it use, as the SubTrees name them.
void addSubTrees(const XmlElement& element, std::vector<std::string>& ids);
/// Those that the trees of a file use, by its <root>.
std::vector<std::string> subTreesOf(const XmlElement& root);
/// The name of the node type: that ID, or the tag.
const std::string& typeNameOf(const XmlElement& element);
/// The node type that an element names; null if there is no such type.
const NodeType* typeOf(const XmlElement& element, const Registry& registry);

/// The name of the node that the element makes: the attribute `name`, else its type or the ID of the SubTree.
const std::string& displayNameOf(const XmlElement& element);

/// The attribute that gives a port its value. Editors write a port without one as `port=""`: null for that too, unless
/// the empty text is a value, which it is for a text that must be given.
const XmlAttribute* givenTo(const PortManifest& port, const XmlElement& element);

/// An attribute of the format itself: name, ID of the explicit form, _description and attributes of editors.
bool isStructural(const XmlElement& element, std::string_view attribute);
/// `_autoremap="true"` of a SubTree.
bool isAutoremapped(const XmlElement& element);

/// "{x}", " { x } " -> "x"; "{=}" -> the port's own name; nothing for a literal.
std::optional<std::string> entryOf(std::string_view text, std::string_view port);
/// A valid name of an entry: not empty, without blanks and braces.
bool isEntryName(std::string_view name);

}  // namespace swiftlet::tree
