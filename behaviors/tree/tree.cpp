#include "behaviors/tree/tree.hpp"

#include <utility>

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

Location Tree::locationOf(int id, std::string_view attribute) const {
  return parts_->locate(parts_->origins[static_cast<std::size_t>(id)], attribute);
}

std::vector<Value> Tree::knownValues(int id, std::string_view port) const {
  std::vector<Value> values;
  const NodeSetup& setup = parts_->setups[static_cast<std::size_t>(id)];
  for (const PortBinding& binding : setup.ports) {
    if (binding.manifest->name != port) continue;
    if (binding.literal) values.push_back(*binding.literal);
    if (binding.slot == nullptr) continue;
    for (const LiteralWrite* literal : parts_->literalsOf(binding.slot->id))
      if (auto value = readValue(*binding.manifest, literal->text).value) values.push_back(std::move(*value));
  }
  return values;
}

Location TreeParts::locate(const NodeOrigin& origin, std::string_view attribute) const {
  const SourceText& source = sources[origin.file];
  return attribute.empty() ? source.locate(origin.offset) : source.locate(origin.offset, attribute);
}

}  // namespace swiftlet::tree
