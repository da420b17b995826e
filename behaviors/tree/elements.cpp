#include "behaviors/tree/elements.hpp"

#include <algorithm>
#include <array>

namespace swiftlet::tree {
namespace {

template <std::size_t N>
bool isOneOf(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::optional<NodeKind> explicitKind(std::string_view tag) {
  if (tag == "Action") return NodeKind::kAction;
  if (tag == "Condition") return NodeKind::kCondition;
  if (tag == "Control") return NodeKind::kControl;
  if (tag == "Decorator") return NodeKind::kDecorator;
  return std::nullopt;
}

void addSubTrees(const XmlElement& element, std::vector<std::string>& ids) {
  if (const std::string* id = element.attribute("ID"); id != nullptr && isSubTree(element)) ids.push_back(*id);
  for (const XmlElement& child : element.children) addSubTrees(child, ids);
}

std::vector<std::string> subTreesOf(const XmlElement& root) {
  std::vector<std::string> ids;
  for (const XmlElement& element : root.children)
    if (element.name == "BehaviorTree") addSubTrees(element, ids);
  return ids;
}

const std::string& typeNameOf(const XmlElement& element) {
  const std::string* id = explicitKind(element.name) ? element.attribute("ID") : nullptr;
  return id == nullptr ? element.name : *id;
}

const NodeType* typeOf(const XmlElement& element, const Registry& registry) {
  return registry.find(typeNameOf(element));
}

const std::string& displayNameOf(const XmlElement& element) {
  if (const std::string* name = element.attribute("name"); name != nullptr && !name->empty()) return *name;
  const std::string* id = isSubTree(element) || explicitKind(element.name) ? element.attribute("ID") : nullptr;
  return id == nullptr ? element.name : *id;
}

const XmlAttribute* givenTo(const PortManifest& port, const XmlElement& element) {
  const XmlAttribute* attribute = element.find(port.name);
  if (attribute == nullptr || attribute->value.find_first_not_of(" \t\r\n") != std::string::npos) return attribute;
  const bool text = (port.type == PortType::kAny || port.type == PortType::kString) && allowedTexts(port).empty() &&
                    port.direction == Direction::kInput && !port.names_entry;
  return text && (port.required || !attribute->value.empty()) ? attribute : nullptr;
}

bool isStructural(const XmlElement& element, std::string_view attribute) {
  constexpr std::array<std::string_view, 5> kEverywhere = {"name", "_description", "_uid", "_fullpath", "_fullPath"};
  if (attribute == "ID") return isSubTree(element) || explicitKind(element.name).has_value();
  if (attribute == "_autoremap") return isSubTree(element);
  return isOneOf(attribute, kEverywhere);
}

bool isAutoremapped(const XmlElement& element) {
  const std::string* value = element.attribute("_autoremap");
  return value != nullptr && parseValue(*value, PortType::kBool, {}) == Value(true);
}

std::optional<std::string> entryOf(std::string_view text, std::string_view port) {
  const auto trim = [&text] {
    while (text.starts_with(' ')) text.remove_prefix(1);
    while (text.ends_with(' ')) text.remove_suffix(1);
  };
  trim();
  if (text.size() < 3 || text.front() != '{' || text.back() != '}') return std::nullopt;
  text = text.substr(1, text.size() - 2);
  trim();
  return std::string(text == "=" ? port : text);
}

bool isEntryName(std::string_view name) {
  if (name.starts_with('@')) name.remove_prefix(1);
  return !name.empty() && name.find_first_of("\t\r\n{}") == std::string_view::npos;
}

}  // namespace swiftlet::tree
