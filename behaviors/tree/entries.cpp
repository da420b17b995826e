#include <algorithm>
#include <string>
#include <vector>

#include "behaviors/tree/builder.hpp"

namespace swiftlet::tree {
namespace {

bool fits(PortType written, PortType read) {
  const auto isText = [](PortType type) {
    return type == PortType::kAny || type == PortType::kString || type == PortType::kScript;
  };
  const bool number = written == PortType::kInt || written == PortType::kDouble;
  return isText(written) || isText(read) || written == read || (number && read == PortType::kDuration) ||
         (written == PortType::kInt && read == PortType::kDouble);
}

bool isSet(const EntryFlow& flow) {
  return flow.by_host || flow.literals.size() + flow.copied_from.size() + flow.typed_writes.size() > flow.changes;
}

std::vector<std::string> namesOfSet(const TreeParts& tree) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < tree.slots.size(); ++i)
    if (isSet(tree.flows[i])) names.push_back(tree.slots[i].name);
  return names;
}

/// The usual cause is the same name in another tree: subtrees share entries only if they are mapped.
std::string hintFor(const TreeParts& tree, const std::string& name) {
  const std::vector<std::string> names = namesOfSet(tree);
  if (std::find(names.begin(), names.end(), name) == names.end()) return didYouMean(name, names);
  return "another tree has one of this name: share it by " + name + "=\"{" + name +
         "}\" or _autoremap=\"true\" on the SubTree";
}

void checkEntry(const TreeParts& tree, std::size_t slot, Problems& problems) {
  const EntryFlow& flow = tree.flows[slot];
  const auto pathOf = [&](const NodeOrigin& origin) { return tree.pathOf(origin.node); };
  const std::string entry = "{" + tree.slots[slot].name + "}";
  if (!isSet(flow)) {
    const EntryRead& read = flow.reads.front();
    problems.add({tree.locate(read.origin, read.port->name), read.owner + "." + read.port->name,
                  "nothing sets the entry " + entry, hintFor(tree, tree.slots[slot].name), pathOf(read.origin)});
    return;
  }
  for (const EntryRead& read : flow.reads) {
    const std::string reader = read.owner + "." + read.port->name;
    for (const PortType written : flow.typed_writes)
      if (!fits(written, read.port->type))
        problems.add(
            {tree.locate(read.origin, read.port->name),
             reader,
             "the entry " + entry + " is written as " + toString(written) + ", expected " + expectedOf(*read.port),
             {},
             pathOf(read.origin)});
    if (read.port->type == PortType::kAny || read.port->type == PortType::kScript) continue;
    for (const LiteralWrite* literal : tree.literalsOf(slot))
      if (const ReadValue value = readValue(*read.port, literal->text); !value.value)
        problems.add({tree.locate(literal->origin, literal->attribute),
                      literal->attribute,
                      value.problem + " (read by " + reader + " from " + entry + ")",
                      {},
                      pathOf(literal->origin)});
  }
}

}  // namespace

void checkEntries(const TreeParts& tree, Problems& problems) {
  for (std::size_t i = 0; i < tree.slots.size() && !problems.full(); ++i)
    if (!tree.flows[i].reads.empty()) checkEntry(tree, i, problems);
}

std::vector<std::size_t> TreeParts::sourcesOf(std::size_t slot) const {
  std::vector<std::size_t> reached = {slot};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const std::size_t from : flows[reached[i]].copied_from)
      if (reached.size() < kMaxCopies && std::find(reached.begin(), reached.end(), from) == reached.end())
        reached.push_back(from);
  return reached;
}

std::vector<const LiteralWrite*> TreeParts::literalsOf(std::size_t slot) const {
  std::vector<const LiteralWrite*> literals;
  for (const std::size_t source : sourcesOf(slot))
    for (const LiteralWrite& literal : flows[source].literals) literals.push_back(&literal);
  return literals;
}

bool TreeParts::isOnlyWrittenAsText(std::size_t slot) const {
  const std::vector<std::size_t> sources = sourcesOf(slot);
  return sources.size() < kMaxCopies && std::all_of(sources.begin(), sources.end(), [&](std::size_t source) {
           return flows[source].typed_writes.empty() && !flows[source].by_host;
         });
}

}  // namespace swiftlet::tree
