#include "behaviors/tree/flow_recorder.hpp"

#include <algorithm>

namespace swiftlet::tree {
namespace {

/// The input from which an output gets its value unchanged: the input of any type.
const PortBinding* copiedInput(const NodeSetup& setup) {
  for (const PortBinding& binding : setup.ports)
    if (binding.manifest->direction == Direction::kInput && binding.manifest->type == PortType::kAny) return &binding;
  return nullptr;
}

bool isText(const Value& value) { return std::holds_alternative<std::string>(value); }

}  // namespace

void FlowRecorder::recordPorts(const NodeOrigin& origin, const NodeManifest& manifest, const NodeSetup& setup) {
  for (const PortBinding& binding : setup.ports) {
    if (binding.slot == nullptr) continue;
    if (binding.manifest->direction != Direction::kOutput)
      recordRead(binding.slot->id, origin, manifest.id, *binding.manifest);
    if (binding.manifest->unsets)
      flows_[binding.slot->id].is_unset = true;
    else if (binding.manifest->direction != Direction::kInput)
      recordOutput(origin, setup, binding);
  }
}

void FlowRecorder::recordOutput(const NodeOrigin& origin, const NodeSetup& setup, const PortBinding& output) {
  const std::size_t slot = output.slot->id;
  const PortManifest& port = *output.manifest;
  flows_[slot].is_set = true;
  if (!port.element_of.empty() && recordElements(origin, setup.port(port.element_of), output)) return;
  const PortBinding* copied = port.type == PortType::kAny ? copiedInput(setup) : nullptr;
  if (copied == nullptr)
    recordType(slot, port.type);
  else if (copied->slot != nullptr)
    recordCopy(slot, copied->slot->id);
  else if (copied->literal)
    recordLiteral(slot, {toString(*copied->literal), origin, copied->manifest->name, isText(*copied->literal)});
}

/// False if more values may be written than these: the queue is in an entry, or it is long.
bool FlowRecorder::recordElements(const NodeOrigin& origin, const PortBinding& queue, const PortBinding& output) {
  if (!queue.literal) return false;
  std::string_view left = std::get<std::string>(*queue.literal);
  constexpr int kMost = 1000;
  for (int i = 0; !left.empty(); ++i) {
    if (i == kMost) return false;
    const std::size_t end = left.find(';');
    if (const auto element = parseValue(left.substr(0, end), output.manifest->type, {}))
      recordLiteral(output.slot->id, {toString(*element), origin, queue.manifest->name, isText(*element)});
    left.remove_prefix(end == std::string_view::npos ? left.size() : end + 1);
  }
  return true;
}

void FlowRecorder::recordScript(const Script& script, const NodeOrigin& origin, const std::string& owner,
                                const PortManifest& port) {
  const auto entries = script.entries();
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (entries[i].read) recordRead(script.slot(i).id, origin, owner, port);
  for (const ScriptPairing& pairing : script.pairings())
    pairings_.push_back({&script, pairing, {&port, owner, origin}});
  for (const ScriptWrite& write : script.writes()) {
    const std::size_t slot = script.slot(write.entry).id;
    if (write.makes) flows_[slot].is_set = true;
    if (write.constant)
      recordLiteral(slot, {toString(script.constant(*write.constant)), origin, port.name,
                           isText(script.constant(*write.constant))});
    else if (write.copied)
      recordCopy(slot, script.slot(*write.copied).id);
    else
      recordType(slot, write.type);
  }
}

void FlowRecorder::recordRead(std::size_t slot, const NodeOrigin& origin, const std::string& owner,
                              const PortManifest& port) {
  auto& reads = flows_[slot].reads;
  const auto known =
      std::find_if(reads.begin(), reads.end(), [&](const EntryRead& read) { return read.port == &port; });
  if (known == reads.end()) reads.push_back({&port, owner, origin});
}

void FlowRecorder::recordLiteral(std::size_t slot, LiteralWrite literal) {
  if (literals_.emplace(slot, literal.is_text, literal.text).second)
    flows_[slot].literals.push_back(std::move(literal));
}

void FlowRecorder::recordCopy(std::size_t slot, std::size_t from) {
  if (copies_.emplace(slot, from).second) flows_[slot].copied_from.push_back(from);
}

void FlowRecorder::recordType(std::size_t slot, PortType type) {
  auto& types = flows_[slot].typed_writes;
  if (std::find(types.begin(), types.end(), type) == types.end()) types.push_back(type);
}

}  // namespace swiftlet::tree
