#include "behaviors/tree/parameters.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "behaviors/tree/document.hpp"
#include "behaviors/tree/elements.hpp"
#include "behaviors/tree/parse_options.hpp"
#include "behaviors/tree/version3.hpp"
#include "behaviors/tree/xml_text.hpp"

namespace swiftlet::tree {
namespace {

/// Called for each port that is a parameter.
using Visit = std::function<void(const XmlElement& element, Parameter parameter)>;

class ParameterReader {
 public:
  ParameterReader(const Registry& registry, const Visit& visit)
      : registry_(registry), engine_(Registry::standard()), visit_(visit) {}

  void read(const XmlElement& root) {
    for (const XmlElement& tree : root.children) {
      const std::string* id = tree.attribute("ID");
      if (tree.name != "BehaviorTree") continue;
      for (const XmlElement& child : tree.children)
        readElement(child, (id == nullptr ? tree.name : *id) + "/" + displayNameOf(child));
    }
  }

 private:
  /// Depth is bounded by that of the XML.
  void readElement(const XmlElement& element, const std::string& path) {
    const NodeType* type = isSubTree(element) ? nullptr : typeOf(element, registry_);
    if (type != nullptr && type->manifest.maxChildren() == 0 && engine_.find(type->manifest.id) == nullptr)
      for (const PortManifest& port : type->manifest.ports) readPort(element, path, port);
    std::map<std::string, int> all, seen;
    for (const XmlElement& child : element.children) ++all[displayNameOf(child)];
    for (const XmlElement& child : element.children) {
      const std::string name = displayNameOf(child);
      const std::string index = all[name] > 1 ? "[" + std::to_string(++seen[name]) + "]" : "";
      readElement(child, path + "/" + name + index);
    }
  }

  void readPort(const XmlElement& element, const std::string& path, const PortManifest& port) {
    const XmlAttribute* given = givenTo(port, element);
    if (port.direction != Direction::kInput || port.type == PortType::kScript) return;
    if (given != nullptr && entryOf(given->value, port.name)) return;
    visit_(element, {path + "." + port.name, displayNameOf(element),
                     given == nullptr ? port.default_value.value_or("") : given->value, &port});
  }

  const Registry& registry_;
  Registry engine_;
  const Visit& visit_;
};

/// The edit that gives a port a value; nothing if it has that already.
std::optional<Edit> editOf(const SourceText& source, const XmlElement& element, const Parameter& parameter,
                           const std::string& value) {
  if (value == parameter.value) return std::nullopt;
  if (const auto span = source.spanOf(element.offset, parameter.port->name)) {
    if (value.empty()) return Edit{span->name, span->closing_quote + 1, {}};
    return Edit{span->opening_quote + 1, span->closing_quote, escaped(value)};
  }
  const std::size_t name_end = element.offset + 1 + element.name.size();
  return Edit{name_end, name_end, " " + parameter.port->name + "=\"" + escaped(value) + "\""};
}

std::optional<Message> problemWith(const Parameter& parameter, const std::string& value) {
  if (!value.empty()) return readValue(*parameter.port, value).problem;
  return parameter.port->required ? std::optional(Message("tree.parameter-required", "it is required")) : std::nullopt;
}

}  // namespace

std::vector<Parameter> parametersOf(const std::string& text, const std::string& name, const Registry& registry) {
  const SourceText source(name, text);
  const XmlResult xml = parseXml(source, ParseLimits{}.depth);
  std::vector<Parameter> parameters;
  if (!xml.root) return parameters;
  const Visit visit = [&](const XmlElement&, Parameter parameter) { parameters.push_back(std::move(parameter)); };
  ParameterReader(registry, visit).read(*xml.root);
  return parameters;
}

Changed withParameters(const std::string& text, const std::string& name, const Registry& registry,
                       const std::map<std::string, std::string>& values) {
  const SourceText source(name, text);
  XmlResult xml = parseXml(source, ParseLimits{}.depth);
  if (!xml.root) return {{}, {std::move(*xml.problem)}};
  Changed changed;
  std::vector<Edit> edits;
  std::vector<std::string> keys;
  std::size_t used = 0;
  const Visit visit = [&](const XmlElement& element, const Parameter& parameter) {
    keys.push_back(parameter.key);
    const auto value = values.find(parameter.key);
    if (value == values.end()) return;
    ++used;
    if (auto problem = problemWith(parameter, value->second))
      changed.problems.push_back(
          {source.locate(element.offset, parameter.port->name), parameter.key, *std::move(problem)});
    else if (auto edit = editOf(source, element, parameter, value->second))
      edits.push_back(std::move(*edit));
  };
  ParameterReader(registry, visit).read(*xml.root);
  if (used < values.size())
    for (const auto& [key, value] : values)
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        changed.problems.push_back({{name},
                                    key,
                                    Message("tree.unknown-parameter", "the mission has no such parameter"),
                                    didYouMean(key, keys)});
  if (changed.problems.empty()) changed.text = edited(source.text(), std::move(edits));
  return changed;
}

}  // namespace swiftlet::tree
