// How the elements below <BehaviorTree> are read: which node type they name, which attributes are ports, what an
// attribute binds.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "behaviors/tree/registry.hpp"
#include "behaviors/tree/xml.hpp"

namespace swiftlet::tree {

/// <Action>, <Condition>, <Control>, <Decorator>: the type is in the attribute ID.
std::optional<NodeKind> explicitKind(std::string_view tag);
inline bool isSubTree(const XmlElement& element) { return element.name == "SubTree"; }
/// The node type an element names; null when there is none or no such type.
const NodeType* typeOf(const XmlElement& element, const Registry& registry);

/// An attribute that the format itself knows: name, ID of the explicit form, _description and what editors leave
/// behind.
bool isStructural(const XmlElement& element, std::string_view attribute);
/// A pre- or postcondition of the format, which needs scripting.
bool isScripted(std::string_view attribute);
/// `_autoremap="true"` of a SubTree.
bool isAutoremapped(const XmlElement& element);

/// "{x}" -> "x"; "{=}" -> the port's own name; nothing for a literal.
std::optional<std::string> entryOf(std::string_view text, std::string_view port);
/// A name an entry may have: not empty, without blanks and braces.
bool isEntryName(std::string_view name);

}  // namespace swiftlet::tree
