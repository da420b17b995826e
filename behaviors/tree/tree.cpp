#include "behaviors/tree/tree.hpp"

#include <map>
#include <utility>

#include "behaviors/tree/script/script.hpp"
#include "behaviors/tree/tree_parts.hpp"

namespace swiftlet::tree {

Tree::Tree(std::unique_ptr<TreeParts> parts) : parts_(std::move(parts)) {}
Tree::Tree(Tree&&) noexcept = default;
Tree& Tree::operator=(Tree&&) noexcept = default;
Tree::~Tree() = default;

Status Tree::tick(TickContext& context) { return parts_->root->tick(context); }

Release Tree::halt(TickContext& context) { return parts_->root->halt(context); }

bool Tree::set(std::string_view entry, Value value) {
  for (Slot& slot : parts_->slots) {
    if (slot.name != entry || !parts_->flows[slot.id].by_host) continue;
    slot.write(std::move(value));
    return true;
  }
  return false;
}

const std::string& Tree::name() const { return parts_->name; }

const Node& Tree::root() const { return *parts_->root; }

const std::vector<NodeRecord>& Tree::nodes() const { return parts_->records; }

std::vector<NodeView> Tree::view() const {
  std::vector<NodeView> view;
  view.reserve(parts_->records.size());
  for (const NodeRecord& record : parts_->records)
    view.push_back({record.node->id(), record.parent, record.node->name(), record.node->status()});
  return view;
}

std::vector<PortView> Tree::portsOf(int id) const {
  std::vector<PortView> ports;
  const NodeSetup& setup = parts_->setups[static_cast<std::size_t>(id)];
  if (const auto subtree = parts_->subtree_ids.find(id); subtree != parts_->subtree_ids.end())
    ports.push_back({"ID", {}, subtree->second});
  for (const PortBinding& binding : setup.ports) {
    const std::string& name = binding.manifest->name;
    if (binding.script != nullptr)
      ports.push_back({name, {}, std::string(binding.script->text())});
    else if (binding.literal)
      ports.push_back({name, {}, toString(*binding.literal)});
    else if (binding.slot != nullptr)
      ports.push_back({name, binding.slot->name,
                       binding.slot->value ? std::optional(toString(*binding.slot->value)) : std::nullopt});
  }
  if (setup.conditions == nullptr) return ports;
  for (std::size_t kind = 0; kind < kConditionKinds; ++kind)
    if (const Script* script = setup.conditions->scripts[kind])
      ports.push_back({std::string(attributeOf(static_cast<ConditionKind>(kind))), {}, std::string(script->text())});
  return ports;
}

std::uint64_t Tree::writesOfPorts(int id) const {
  std::uint64_t writes = 0;
  for (const PortBinding& binding : parts_->setups[static_cast<std::size_t>(id)].ports)
    if (binding.slot != nullptr) writes += 2 * binding.slot->writes + (binding.slot->value ? 1 : 0);
  return writes;
}

std::string Tree::pathOf(int id) const { return parts_->pathOf(id); }

const Conditions* Tree::conditionsOf(int id) const { return parts_->setups[static_cast<std::size_t>(id)].conditions; }

Location Tree::locationOf(int id, std::string_view attribute) const {
  return parts_->locate(parts_->origins[static_cast<std::size_t>(id)], attribute);
}

std::vector<Value> Tree::knownValues(int id, std::string_view port) const {
  std::vector<Value> values;
  const NodeSetup& setup = parts_->setups[static_cast<std::size_t>(id)];
  for (const PortBinding& binding : setup.ports) {
    if (binding.manifest->name != port) continue;
    if (binding.literal) values.push_back(*binding.literal);
    if (binding.slot != nullptr) values = parts_->valuesOf(binding.slot->id, *binding.manifest);
  }
  return values;
}

bool Tree::knowsEveryValue(int id, std::string_view port) const {
  const PortBinding& binding = parts_->setups[static_cast<std::size_t>(id)].port(port);
  return binding.slot == nullptr || parts_->isOnlyWrittenAsText(binding.slot->id);
}

std::optional<bool> Tree::constantTruth(int id, std::string_view attribute) const {
  const NodeSetup& setup = parts_->setups[static_cast<std::size_t>(id)];
  Script* script = nullptr;
  for (const PortBinding& binding : setup.ports)
    if (binding.manifest->name == attribute) script = binding.script;
  const auto kind = conditionOf(attribute);
  if (kind && setup.conditions != nullptr) script = setup.conditions->scripts[static_cast<std::size_t>(*kind)];
  if (script == nullptr || !script->entries().empty()) return std::nullopt;
  return script->holds();
}

std::string TreeParts::pathOf(int id) const {
  const NodeRecord& record = records[static_cast<std::size_t>(id)];
  const int number = numberAmongSiblings(id);
  return (record.parent < 0 ? name : pathOf(record.parent)) + "/" + record.node->name() +
         (number > 0 ? "[" + std::to_string(number) + "]" : "");
}

int TreeParts::numberAmongSiblings(int id) const {
  if (!numbers_.empty()) return numbers_[static_cast<std::size_t>(id)];
  numbers_.resize(records.size());
  for (const NodeRecord& record : records) {
    std::map<std::string_view, std::vector<int>> by_name;
    for (const auto& child : record.node->children()) by_name[child->name()].push_back(child->id());
    for (const auto& [same, ids] : by_name)
      for (std::size_t i = 0; ids.size() > 1 && i < ids.size(); ++i)
        numbers_[static_cast<std::size_t>(ids[i])] = static_cast<int>(i) + 1;
  }
  return numbers_[static_cast<std::size_t>(id)];
}

Location TreeParts::locate(const NodeOrigin& origin, std::string_view attribute) const {
  const SourceText& source = origin.document->source;
  return attribute.empty() ? source.locate(origin.offset) : source.locate(origin.offset, attribute);
}

}  // namespace swiftlet::tree
