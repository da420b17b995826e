#include "behaviors/tree/builder.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/conditions.hpp"
#include "behaviors/tree/elements.hpp"
#include "behaviors/tree/nodes/subtree.hpp"

namespace swiftlet::tree {

struct Builder::Scope {
  Scope* outer = nullptr;
  bool autoremap = false;
  struct Entry {
    Slot* slot = nullptr;
    bool passed = false;  ///< The SubTree gives it.
    bool used = false;    ///< A node of the tree uses it.
    bool own = false;     ///< It is no entry of an outer tree.
  };
  std::map<std::string, Entry, std::less<>> names;
};

namespace {

std::size_t countOf(const XmlElement& element) {
  std::size_t count = 1;
  for (const XmlElement& child : element.children) count += countOf(child);
  return count;
}

/// Entries that nodes of a tree use and its SubTree does not give.
template <typename Entries>
std::vector<std::string> namesOfNodes(const Entries& entries) {
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries)
    if (!entry.passed) names.push_back(name);
  return names;
}

}  // namespace

Builder::Builder(Documents& documents, const Registry& registry, const ParseOptions& options, Problems& problems,
                 std::unique_ptr<TreeParts> tree)
    : documents_(documents),
      registry_(registry),
      options_(options),
      problems_(problems),
      tree_(std::move(tree)),
      flow_(tree_->flows, tree_->pairings) {
  tree_->name = documents.main_id;
}

Builder::~Builder() = default;

Tree Builder::build() {
  Scope scope;
  main_scope_ = &scope;
  for (const std::string& entry : options_.host_entries) tree_->flows[find(scope, entry)->id].by_host = true;
  const TreeDefinition& main = *documents_.main;
  const std::size_t nodes = std::min(countOf(*main.element), static_cast<std::size_t>(options_.limits.nodes));
  tree_->records.reserve(nodes);
  tree_->setups.reserve(nodes);
  tree_->origins.reserve(nodes);
  tree_->root = makeNode({main.document, &main.element->children.front(), -1, 0}, scope);
  tree_->documents = std::move(documents_.documents);
  addFound();
  if (!gave_up_) {
    checkEntries(*tree_, problems_, options_);
    warnOfNumberTexts(*tree_, problems_);
  }
  return Tree(std::move(tree_));
}

std::unique_ptr<Node> Builder::makeNode(const Place& place, Scope& scope) {
  if (tooLarge(place)) return nullptr;
  return isSubTree(*place.element) ? makeSubTree(place, scope) : makeTyped(place, scope);
}

std::unique_ptr<Node> Builder::makeSubTree(const Place& place, Scope& scope) {
  const std::string& id = *place.element->attribute("ID");
  const int record = addRecord(place, nullptr);
  tree_->setups[static_cast<std::size_t>(record)].name = displayNameOf(*place.element);
  tree_->setups[static_cast<std::size_t>(record)].conditions = makeConditions(place, scope, "SubTree");
  tree_->subtree_ids[record] = id;
  auto node = std::make_unique<SubTree>(tree_->setups[static_cast<std::size_t>(record)]);
  finishRecord(record, *node);

  Scope inner;
  bindSubTree(place, scope, inner, record);
  const TreeDefinition& definition = documents_.trees.find(id)->second;
  if (auto child =
          makeNode({definition.document, &definition.element->children.front(), record, place.depth + 1}, inner))
    node->addChild(std::move(child));
  if (!gave_up_) checkUnused(place, inner, record);
  return node;
}

void Builder::bindSubTree(const Place& place, Scope& outer, Scope& inner, int record) {
  inner.outer = &outer;
  inner.autoremap = isAutoremapped(*place.element);
  const auto bind = [&](const std::string& port, const std::string& text) {
    if (const auto entry = entryOf(text, port)) {
      inner.names[port] = {.slot = find(outer, *entry), .passed = true};
      return;
    }
    Slot* slot = makeSlot(port);
    slot->give(text);
    flow_.recordLiteral(slot->id, {text, originOf(place), port});
    tree_->flows[slot->id].is_set = true;
    inner.names[port] = {.slot = slot, .passed = true, .own = true};
  };
  const auto model = documents_.subtree_models.find(*place.element->attribute("ID"));
  // Where there is a default, an empty attribute counts as missing.
  const auto hasDefault = [&](const std::string& port) {
    const bool known = model != documents_.subtree_models.end() && model->second.contains(port);
    return known && model->second.find(port)->second.has_value();
  };
  for (const XmlAttribute& attribute : place.element->attributes)
    if (!attribute.name.starts_with('_') && !isStructural(*place.element, attribute.name) &&
        (!attribute.value.empty() || !hasDefault(attribute.name)))
      bind(attribute.name, attribute.value);
  // What the outer tree shares takes the place of defaults.
  if (model == documents_.subtree_models.end() || inner.autoremap) return;
  for (const auto& [port, text] : model->second) {
    if (inner.names.contains(port)) continue;
    if (text)
      bind(port, *text);
    else if (!foundEnough())
      report({place.document->at(*place.element), "SubTree",
              Message("tree.subtree-port-missing", "port `{}` is missing, and <TreeNodesModel> gives it no default",
                      port)},
             record);
  }
}

void Builder::checkUnused(const Place& place, const Scope& inner, int record) {
  const std::string& id = *place.element->attribute("ID");
  const auto model = documents_.subtree_models.find(id);
  std::optional<std::vector<std::string>> candidates;
  for (const auto& [port, entry] : inner.names) {
    if (foundEnough()) return;
    if (entry.used) continue;
    if (model != documents_.subtree_models.end() && model->second.contains(port)) continue;
    if (!candidates) candidates = namesOfNodes(inner.names);
    report(
        {place.document->at(*place.element, port), "SubTree",
         Message("tree.unknown-entry", "the tree `{}` has no entry {{{}}}", id, port), didYouMean(port, *candidates)},
        record, options_.lenient);
  }
}

std::unique_ptr<Node> Builder::makeTyped(const Place& place, Scope& scope) {
  const NodeType& type = *typeOf(*place.element, registry_);
  const int record = addRecord(place, &type.manifest);
  NodeSetup setup;
  setup.name = displayNameOf(*place.element);
  setup.conditions = makeConditions(place, scope, type.manifest.id);
  setup.constants = &registry_.constants();
  bindPorts(place, scope, type.manifest, setup);
  flow_.recordPorts(originOf(place), type.manifest, setup);
  auto node = type.build(setup);
  tree_->setups[static_cast<std::size_t>(record)] = std::move(setup);
  finishRecord(record, *node);

  if (!place.element->children.empty()) {
    auto* composite = dynamic_cast<Composite*>(node.get());
    for (const XmlElement& element : place.element->children) {
      auto child = makeNode({place.document, &element, record, place.depth + 1}, scope);
      if (child == nullptr) return node;
      if (composite != nullptr) composite->addChild(std::move(child));
    }
  }
  return node;
}

void Builder::bindPorts(const Place& place, Scope& scope, const NodeManifest& manifest, NodeSetup& setup) {
  setup.ports.reserve(manifest.ports.size());
  for (const PortManifest& port : manifest.ports) {
    PortBinding& binding = setup.ports.emplace_back();
    binding.manifest = &port;
    const XmlAttribute* given = givenTo(port, *place.element);
    if (given == nullptr && !port.default_value) continue;
    const std::string* text = given == nullptr ? &*port.default_value : &given->value;
    if (port.type == PortType::kScript) {
      binding.script = given == nullptr ? tree_->scripts.add(*text).script : scriptOf(*given);
      if (binding.script != nullptr) bindScript(*binding.script, place, scope, manifest.id, port);
    } else if (const auto entry = entryOf(*text, port.name)) {
      binding.slot = find(scope, *entry);
    } else if (port.direction == Direction::kOutput || port.names_entry) {
      binding.slot = find(scope, *text);
    } else {
      binding.literal = readValue(port, *text).value;
    }
    if (port.unsets && !isOwn(scope, entryOf(*text, port.name).value_or(*text))) binding.slot = nullptr;
  }
}

/// Whether the tree of the scope has the entry itself. The name has been looked for.
bool Builder::isOwn(const Scope& scope, std::string_view name) {
  const auto known = scope.names.find(name);
  return known != scope.names.end() && known->second.own;
}

Conditions* Builder::makeConditions(const Place& place, Scope& scope, const std::string& owner) {
  Conditions* conditions = nullptr;
  for (const XmlAttribute& attribute : place.element->attributes) {
    const auto kind = conditionOf(attribute.name);
    if (!kind || attribute.value.empty()) continue;
    if (conditions == nullptr) conditions = &tree_->conditions.emplace_back();
    Script* script = scriptOf(attribute);
    bindScript(*script, place, scope, owner, portOf(*kind));
    conditions->scripts[static_cast<std::size_t>(*kind)] = script;
  }
  return conditions;
}

/// The script that the Checker has made; another where a subtree is used again, because each use has its own entries.
Script* Builder::scriptOf(const XmlAttribute& attribute) {
  Script* script = std::exchange(attribute.script, nullptr);
  return script != nullptr ? script : tree_->scripts.add(attribute.value).script;
}

void Builder::bindScript(Script& script, const Place& place, Scope& scope, const std::string& owner,
                         const PortManifest& port) {
  const auto entries = script.entries();
  for (std::size_t i = 0; i < entries.size(); ++i) script.bind(i, find(scope, entries[i].name));
  flow_.recordScript(script, originOf(place), owner, port);
}

int Builder::addRecord(const Place& place, const NodeManifest* manifest) {
  tree_->records.push_back({nullptr, place.parent, manifest});
  tree_->setups.emplace_back();
  tree_->origins.push_back(originOf(place));
  return static_cast<int>(tree_->records.size()) - 1;
}

void Builder::finishRecord(int id, Node& node) {
  node.setId(id);
  tree_->records[static_cast<std::size_t>(id)].node = &node;
}

Slot* Builder::find(Scope& scope, std::string_view name) {
  if (name.starts_with('@')) return find(*main_scope_, name.substr(1));
  if (const auto known = scope.names.find(name); known != scope.names.end()) {
    known->second.used = true;
    return known->second.slot;
  }
  const bool outer = scope.autoremap && scope.outer != nullptr && !name.starts_with('_');
  Slot* slot = outer ? find(*scope.outer, name) : makeSlot(name);
  scope.names.emplace(name, Scope::Entry{.slot = slot, .used = true, .own = !outer});
  return slot;
}

Slot* Builder::makeSlot(std::string_view name) {
  Slot& slot = tree_->slots.emplace_back();
  slot.name = name;
  slot.id = tree_->slots.size() - 1;
  tree_->flows.emplace_back();
  return &slot;
}

/// Of the node whose record was added last: its children follow when all of it is known.
NodeOrigin Builder::originOf(const Place& place) const {
  return {place.document, place.element->offset, static_cast<int>(tree_->records.size()) - 1};
}

bool Builder::tooLarge(const Place& place) {
  if (gave_up_) return true;
  const ParseLimits& limits = options_.limits;
  const bool deep = place.depth >= limits.depth;
  if (!deep && static_cast<int>(tree_->records.size()) < limits.nodes) return false;
  gave_up_ = true;
  report({place.document->at(*place.element),
          place.element->name,
          deep ? Message("tree.nodes-deep", "nodes are nested deeper than {}, subtrees included", limits.depth)
               : Message("tree.nodes-many", "more than {} nodes, subtrees included", limits.nodes),
          {},
          "/" + displayNameOf(*place.element)},
         place.parent);
  return true;
}

void Builder::report(Problem problem, int node, bool is_warning) {
  if (!foundEnough()) found_.push_back({std::move(problem), node, is_warning});
}

bool Builder::foundEnough() const { return found_.size() > static_cast<std::size_t>(options_.limits.problems); }

/// Paths count siblings, so that they are known when the tree is complete.
void Builder::addFound() {
  for (auto& [problem, node, is_warning] : found_) {
    std::string path = node < 0 ? tree_->name : tree_->pathOf(node);
    constexpr std::size_t kMost = 400;
    if (path.size() > kMost) path = path.substr(0, kMost / 2) + " ... " + path.substr(path.size() - kMost / 2);
    problem.path = path + problem.path;
    if (is_warning)
      problems_.warn(std::move(problem));
    else
      problems_.add(std::move(problem));
  }
}

}  // namespace swiftlet::tree
