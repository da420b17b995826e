#include "behaviors/tree/checker.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/core.h>

#include "behaviors/tree/conditions.hpp"
#include "behaviors/tree/document_problems.hpp"
#include "behaviors/tree/elements.hpp"
#include "behaviors/tree/nodes/threshold.hpp"

namespace swiftlet::tree {
namespace {

constexpr const char* kIntoSequence = "put them into a <Sequence>";

/// Types of BehaviorTree.CPP that this engine does not have, with what to write instead.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kElsewhere = {
    {{"ConsumeQueue", "use LoopDouble, LoopInt, LoopBool or LoopString"},
     {"EntryUpdated", "use WasEntryUpdated"},
     {"ManualSelector", "use OperatorCommand"},
     {"SequenceStar", "use SequenceWithMemory"}}};

/// The attributes of the format that begin with `_` and that people write.
std::vector<std::string> underscoredNames(bool subtree) {
  std::vector<std::string> names = {"_description"};
  if (subtree) names.push_back("_autoremap");
  for (std::size_t i = 0; i < kConditionKinds; ++i) names.emplace_back(attributeOf(static_cast<ConditionKind>(i)));
  return names;
}

/// "exactly 1", "2 or 3", "at least 2" or "none".
std::string expectedChildren(const NodeManifest& manifest) {
  const int least = manifest.minChildren(), most = manifest.maxChildren();
  if (most == 0) return "none";
  if (least == most) return fmt::format("exactly {}", least);
  if (least + 1 == most) return fmt::format("{} or {}", least, most);
  return fmt::format("at least {}", least);
}

std::vector<std::string> portNames(const NodeManifest& manifest) {
  std::vector<std::string> names;
  for (const PortManifest& port : manifest.ports) names.push_back(port.name);
  return names;
}

/// "`clearance_cm` is in centimetres, expected `clearance_m` in metres", if only the unit differs.
std::optional<Message> otherUnit(std::string_view given, const NodeManifest& manifest) {
  for (const PortManifest& port : manifest.ports) {
    const auto expected = unitInWords(unitOf(port.name));
    if (expected.empty() || withoutUnit(port.name) != withoutUnit(given)) continue;
    const auto actual = unitInWords(unitOf(given));
    return Message("tree.port-unit", "port `{}` is {}{}, expected `{}` in {}", given,
                   actual.empty() ? "without a unit" : "in ", actual, port.name, expected);
  }
  return std::nullopt;
}

/// The main tree and those that it uses, directly or not.
std::set<std::string> usedTrees(const Documents& documents) {
  std::set<std::string> used;
  if (documents.main == nullptr) return used;
  for (std::vector<std::string> ids = {documents.main_id}; !ids.empty();) {
    const std::string id = std::move(ids.back());
    ids.pop_back();
    const auto tree = documents.trees.find(id);
    if (tree != documents.trees.end() && used.insert(id).second) addSubTrees(*tree->second.element, ids);
  }
  return used;
}

/// The trees that have the name of a type which is not of the engine.
std::set<std::string> treesNamedAsTypes(const Documents& documents, const Registry& registry) {
  std::set<std::string> ids;
  for (const auto& [id, tree] : documents.trees)
    if (registry.find(id) != nullptr) ids.insert(id);
  if (ids.empty()) return ids;
  const Registry engine = Registry::standard();
  std::erase_if(ids, [&](const std::string& id) { return engine.find(id) != nullptr; });
  return ids;
}

}  // namespace

Checker::Checker(const Documents& documents, const Registry& registry, Problems& problems, Scripts& scripts,
                 bool lenient)
    : documents_(documents),
      registry_(registry),
      problems_(problems),
      scripts_(scripts),
      lenient_(lenient),
      used_(usedTrees(documents)),
      trees_not_types_(lenient ? treesNamedAsTypes(documents, registry) : std::set<std::string>()),
      node_names_(registry.ids()) {
  node_names_.push_back("SubTree");
  for (const auto& [id, tree] : documents.trees) tree_names_.push_back(id);
}

void Checker::check() {
  // In the order of the files, not of the names.
  for (const auto& document : documents_.documents) {
    for (const XmlElement& element : document->root.children) {
      const std::string* id = element.attribute("ID");
      const auto tree = documents_.trees.find(id == nullptr ? "BehaviorTree" : *id);
      const bool is_here = tree != documents_.trees.end() && tree->second.element == &element;
      // Of a file elsewhere only what is used belongs to this tree.
      if (is_here && (!document->is_elsewhere || used_.contains(tree->first))) checkTree(tree->first, tree->second);
    }
  }
  checkRecursion();
}

void Checker::checkTree(const std::string& id, const TreeDefinition& tree) {
  tree_id_ = id;
  if (foundEnough()) return;
  const XmlElement& element = *tree.element;
  const Document& document = *tree.document;
  if (registry_.find(id) != nullptr) reportNamedAsType(document, element, id);
  if (element.children.size() != 1)
    report({document.at(element), element.name,
            Message("tree.root-count", "`{}` has {} children, expected 1", id, element.children.size()),
            element.children.empty() ? "" : kIntoSequence});
  if (element.text_offset) report(strayText(document, element));
  for (const XmlElement& child : element.children) checkElement(document, child);
}

void Checker::reportNamedAsType(const Document& document, const XmlElement& element, const std::string& id) {
  const Location place = document.at(element, "ID");
  const std::string hint = fmt::format("give the tree another ID, as `{}Tree`, here and where it is used", id);
  if (!isTreeNotType(id))
    return report({place, element.name, Message("tree.id-is-type", "`{}` is the name of a node type", id), hint});
  warn({place, element.name,
        Message("tree.id-hides-type", "`{}` is the name of a node type too, and here only that of the tree", id),
        hint});
}

void Checker::checkElement(const Document& document, const XmlElement& element) {
  if (foundEnough()) return;
  open_.push_back(&element);
  if (isSubTree(element))
    checkSubTree(document, element);
  else if (const NodeType* type = typeOf(element, registry_); type != nullptr && !isTreeNotType(type->manifest.id))
    checkNode(document, element, type->manifest);
  else
    checkUnknown(document, element);
  if (element.text_offset) report(strayText(document, element));
  for (const XmlElement& child : element.children) checkElement(document, child);
  open_.pop_back();
}

bool Checker::isUnused() const { return lenient_ && !used_.empty() && !used_.contains(tree_id_); }

bool Checker::foundEnough() const { return problems_.full() || (isUnused() && problems_.fullOfWarnings()); }

void Checker::report(Problem problem) {
  if (isUnused()) return warn(std::move(problem));
  problem.path = path();
  problems_.add(std::move(problem));
}

void Checker::warn(Problem warning) {
  if (problems_.fullOfWarnings()) return;
  warning.path = path();
  problems_.warn(std::move(warning));
}

std::string Checker::path() const {
  std::string path = tree_id_;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    const std::string& name = displayNameOf(*open_[i]);
    path += "/" + name;
    if (i == 0) continue;
    int before = 0, all = 0;
    for (const XmlElement& sibling : open_[i - 1]->children) {
      if (&sibling == open_[i]) before = all;
      if (displayNameOf(sibling) == name) ++all;
    }
    if (all > 1) path += fmt::format("[{}]", before + 1);
  }
  return path;
}

void Checker::checkSubTree(const Document& document, const XmlElement& element) {
  const std::string* id = element.attribute("ID");
  if (id == nullptr)
    report(missingAttribute(document, element, "ID"));
  else if (!documents_.trees.contains(*id))
    reportNoTree(document, element, *id);
  else
    uses_[tree_id_].try_emplace(*id, Use{&document, &element});
  if (!element.children.empty())
    report({document.at(element), element.name, Message("tree.subtree-children", "a SubTree has no children here")});
  for (const XmlAttribute& attribute : element.attributes) checkAttribute(document, element, attribute, nullptr);
}

void Checker::reportNoTree(const Document& document, const XmlElement& element, const std::string& id) {
  std::string hint = documents_.includeFor(document, id);
  if (hint.empty()) hint = didYouMean(id, tree_names_);
  if (hint.empty())
    hint = lenient_ ? "name the file that has it too: check --mock-leaves " + document.source.file() + " OTHER.xml"
                    : "a tree of another file needs <include path=\"OTHER.xml\"/> below <root>";
  report(unknownTree(document, element, "ID", std::move(hint)));
}

void Checker::checkNode(const Document& document, const XmlElement& element, const NodeManifest& manifest) {
  if (const auto kind = explicitKind(element.name); kind && *kind != manifest.kind) {
    reportForeign({document.at(element), element.name,
                   Message("tree.wrong-kind", "`{}` is not of this kind", manifest.id),
                   fmt::format("write <{} ID=\"{}\">", toString(manifest.kind), manifest.id)});
  }
  for (const XmlAttribute& attribute : element.attributes) checkAttribute(document, element, attribute, &manifest);
  for (const PortManifest& port : manifest.ports)
    if (port.required && givenTo(port, element) == nullptr)
      report({document.at(element, port.name), manifest.id,
              Message("tree.port-missing", "port `{}` is {}, expected {}", port.name,
                      element.find(port.name) == nullptr ? "missing" : "empty", expectedOf(port))});
  checkChildren(document, element, manifest);
}

void Checker::checkUnknown(const Document& document, const XmlElement& element) {
  const bool is_explicit = explicitKind(element.name).has_value();
  if (is_explicit && element.attribute("ID") == nullptr) return report(missingAttribute(document, element, "ID"));
  const std::string& id = typeNameOf(element);
  const Location place = is_explicit ? document.at(element, "ID") : document.at(element);
  const bool is_tree = documents_.trees.contains(id);
  const auto* other =
      std::find_if(kElsewhere.begin(), kElsewhere.end(), [&](const auto& known) { return known.first == id; });
  if (other != kElsewhere.end() && !is_tree)
    return report(
        {place, element.name,
         Message("tree.foreign-node", "`{}` is a node of BehaviorTree.CPP that this engine does not have", id),
         std::string(other->second)});
  report({place, element.name, Message("tree.unknown-node", "unknown node `{}`", id),
          is_tree ? fmt::format("a tree is used as <SubTree ID=\"{}\"/>", id) : didYouMean(id, node_names_)});
}

void Checker::checkAttribute(const Document& document, const XmlElement& element, const XmlAttribute& attribute,
                             const NodeManifest* manifest) {
  if (foundEnough()) return;
  const std::string& name = attribute.name;
  const auto place = [&] { return document.at(element, name); };
  const auto owner = [&] { return typeNameOf(element); };
  if (isStructural(element, name)) {
    if (name == "_autoremap" && !attribute.value.empty())
      if (auto problem = readValue({.name = name, .type = PortType::kBool}, attribute.value).problem)
        report({place(), owner() + "." + name, *std::move(problem)});
    return;
  }
  if (const auto condition = conditionOf(name)) {
    if (!attribute.value.empty()) checkScript(document, element, attribute, portOf(*condition));
    return;
  }
  const PortManifest* port = manifest == nullptr ? nullptr : manifest->findPort(name);
  if (port != nullptr && givenTo(*port, element) == nullptr) return;
  const bool script = port != nullptr && port->type == PortType::kScript;
  if (const auto entry = entryOf(attribute.value, name); entry && !script && !isEntryName(*entry))
    return reportNoEntry(document, element, attribute);
  if (port != nullptr) {
    checkPort(document, element, attribute, *port);
  } else if (name.starts_with('_')) {
    reportForeign(unknownAttribute(document, element, name,
                                   name == "__shared_blackboard"
                                       ? "did you mean `_autoremap`?"
                                       : didYouMean(name, underscoredNames(isSubTree(element)))));
  } else if (manifest != nullptr) {
    const auto names = portNames(*manifest);
    const auto unknown = Message("tree.unknown-port", "unknown port `{}`, expected {}", name,
                                 names.empty() ? "no ports" : quotedList(names));
    report({place(), owner(), otherUnit(name, *manifest).value_or(unknown), didYouMean(name, names)});
  }
}

void Checker::reportForeign(Problem problem) {
  if (lenient_)
    warn(std::move(problem));
  else
    report(std::move(problem));
}

void Checker::reportNoEntry(const Document& document, const XmlElement& element, const XmlAttribute& attribute) {
  report({document.at(element, attribute.name), typeNameOf(element) + "." + attribute.name,
          Message("tree.not-an-entry", "`{}` is not an entry, expected `{{name}}`", attribute.value)});
}

void Checker::checkPort(const Document& document, const XmlElement& element, const XmlAttribute& attribute,
                        const PortManifest& port) {
  if (port.type == PortType::kScript) return checkScript(document, element, attribute, port);
  if (entryOf(attribute.value, port.name)) return;
  if (port.direction == Direction::kOutput || port.names_entry) {
    // The key of SetBlackboard, and an entry that is watched, may be written without braces.
    if (port.type == PortType::kAny && isEntryName(attribute.value)) return;
    return reportNoEntry(document, element, attribute);
  }
  ReadValue read = readValue(port, attribute.value);
  if (!read.value)
    report({document.at(element, port.name), typeNameOf(element) + "." + port.name, *std::move(read.problem),
            didYouMean(attribute.value, allowedTexts(port))});
  else if (port.counts_children && !element.children.empty())
    checkCount(document, element, port, std::get<std::int64_t>(*read.value));
}

void Checker::checkCount(const Document& document, const XmlElement& element, const PortManifest& port,
                         std::int64_t count) {
  const std::size_t children = element.children.size();
  if (auto problem = tooMany(port.name, count, children))
    report({document.at(element, port.name), typeNameOf(element), *std::move(problem)});
  else if (threshold(count, children) == 0)
    warn({document.at(element, port.name), typeNameOf(element),
          Message("tree.count-at-once", "{} is {}, which is reached before any child has ended", port.name, count)});
}

void Checker::checkScript(const Document& document, const XmlElement& element, const XmlAttribute& attribute,
                          const PortManifest& port) {
  const auto reportHere = [&](Message message, std::string hint = {}) {
    report({document.at(element, attribute.name), typeNameOf(element) + "." + port.name, std::move(message),
            std::move(hint)});
  };
  if (const auto entry = entryOf(attribute.value, port.name))
    return reportHere(
        Message("tree.script-in-entry", "a script stands in the file, it is not read from the entry {{{}}}", *entry));
  auto [script, problem] = scripts_.add(attribute.value);
  attribute.script = script;
  if (problem)
    reportHere(*std::move(problem));
  else if (port.asked && !script->writes().empty())
    reportHere(Message("tree.script-assigns", "it assigns to an entry, but is only asked"), "use == to compare");
}

void Checker::checkChildren(const Document& document, const XmlElement& element, const NodeManifest& manifest) {
  const auto children = static_cast<int>(element.children.size());
  if (children >= manifest.minChildren() && children <= manifest.maxChildren()) return;
  report({document.at(element), manifest.id,
          Message("tree.children-count", "has {} {}, expected {}", children, children == 1 ? "child" : "children",
                  expectedChildren(manifest)),
          manifest.kind == NodeKind::kDecorator && children > 1 ? kIntoSequence : manifest.about_children});
}

/// Opens the elements from `from` down to `wanted`; false, with nothing opened, if it is not below.
bool Checker::openUpTo(const XmlElement& from, const XmlElement* wanted) {
  open_.push_back(&from);
  if (&from == wanted) return true;
  for (const XmlElement& child : from.children)
    if (openUpTo(child, wanted)) return true;
  open_.pop_back();
  return false;
}

/// Depth-first over the uses. A tree that is reached again while it is open contains itself.
void Checker::checkRecursion() {
  enum class Mark : unsigned char { kNew, kOpen, kDone };
  std::map<std::string, Mark> marks;
  for (const auto& [start, unused] : uses_) {
    if (marks[start] == Mark::kDone) continue;
    using Next = std::map<std::string, Use>::const_iterator;
    std::vector<std::pair<std::string, Next>> path = {{start, uses_[start].begin()}};
    marks[start] = Mark::kOpen;
    while (!path.empty() && !problems_.full()) {
      auto& [id, next] = path.back();
      if (next == uses_[id].end()) {
        marks[id] = Mark::kDone;
        path.pop_back();
        continue;
      }
      const std::string& used = next->first;
      const Use& use = (next++)->second;
      if (!uses_.contains(used) || marks[used] == Mark::kDone) continue;
      if (marks[used] == Mark::kNew) {
        marks[used] = Mark::kOpen;
        path.emplace_back(used, uses_[used].begin());
        continue;
      }
      std::string chain;
      const auto first = std::find_if(path.begin(), path.end(), [&](const auto& step) { return step.first == used; });
      for (auto step = first; step != path.end(); ++step) chain += step->first + " -> ";
      tree_id_ = path.back().first;
      open_.clear();
      for (const XmlElement& child : documents_.trees.find(tree_id_)->second.element->children)
        if (openUpTo(child, use.element)) break;
      report({use.document->at(*use.element), "SubTree",
              Message("tree.contains-itself", "the tree contains itself: {}{}", chain, used),
              "a <Repeat> around it runs a tree again"});
      open_.clear();
    }
  }
}

}  // namespace swiftlet::tree
