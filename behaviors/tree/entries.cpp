#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

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

bool isSet(const EntryFlow& flow) { return flow.by_host || flow.is_set; }

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
  return fmt::format(
      "another tree has one of this name: share it by {0}=\"{{{0}}}\" or _autoremap=\"true\" on the SubTree", name);
}

/// Where scripts only change the entry, the usual cause is `=` in the place of `:=`.
std::string hintFor(const EntryFlow& flow, const std::string& name) {
  if (flow.literals.empty() && flow.typed_writes.empty() && flow.copied_from.empty()) return {};
  if (flow.literals.empty()) return "`:=` makes an entry: " + name + " := ...";
  const std::string& text = flow.literals.front().text;
  const bool plain = parseValue(text, PortType::kDouble, {}) || parseValue(text, PortType::kBool, {});
  return "`:=` makes an entry: " + name + " := " + (plain ? text : "'" + text + "'");
}

/// RED or THE_ANSWER.
bool looksLikeConstant(std::string_view name) {
  return name.size() > 1 && name.front() >= 'A' && name.front() <= 'Z' &&
         name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string_view::npos;
}

class EntryChecker {
 public:
  EntryChecker(const TreeParts& tree, Problems& problems, const ParseOptions& options)
      : tree_(tree), problems_(problems), options_(options) {}

  void check(std::size_t slot) {
    const EntryFlow& flow = tree_.flows[slot];
    if (!isSet(flow)) {
      reportNotSet(slot, flow.reads.front());
      return;
    }
    for (const EntryRead& read : flow.reads) {
      for (const PortType written : flow.typed_writes)
        if (!fits(written, read.port->type)) reportType(slot, read, written);
      if (read.port->type == PortType::kAny || read.port->type == PortType::kScript) continue;
      for (const std::size_t source : tree_.sourcesOf(slot)) checkLiterals(source, slot, read);
    }
  }

 private:
  /// A text that several entries are copied from is judged once for a port.
  void checkLiterals(std::size_t source, std::size_t slot, const EntryRead& read) {
    if (!judged_.emplace(source, read.port).second) return;
    for (const LiteralWrite& literal : tree_.flows[source].literals) {
      if (problems_.full()) return;
      auto problem = readValue(*read.port, literal.text).problem;
      if (!problem) continue;
      problem->append(fmt::format(" (read by {} from {})", nameOf(read), nameOf(slot)));
      problems_.add({tree_.locate(literal.origin, literal.attribute),
                     literal.attribute,
                     *std::move(problem),
                     {},
                     tree_.pathOf(literal.origin.node)});
    }
  }

  void reportNotSet(std::size_t slot, const EntryRead& read) {
    if (options_.user_sets_entries) return;
    const std::string& name = tree_.slots[slot].name;
    Problem problem{tree_.locate(read.origin, read.port->name), nameOf(read),
                    Message("tree.entry-unset", "nothing sets the entry {}", nameOf(slot)), hintFor(tree_, name),
                    tree_.pathOf(read.origin.node)};
    if (problem.hint.empty()) problem.hint = hintFor(tree_.flows[slot], name);
    const bool constant = options_.lenient && read.port->type == PortType::kScript && looksLikeConstant(name);
    if (!constant && !options_.host_sets_entries) {
      problems_.add(std::move(problem));
      return;
    }
    if (constant)
      problem.hint = "unless it is a constant of the program that ticks the tree";
    else if (problem.hint.empty())
      problem.hint = "unless the program that ticks the tree does";
    problems_.warn(std::move(problem));
  }
  void reportType(std::size_t slot, const EntryRead& read, PortType written) {
    problems_.add({tree_.locate(read.origin, read.port->name),
                   nameOf(read),
                   Message("tree.entry-type", "the entry {} is written as {}, expected {}", nameOf(slot),
                           toString(written), expectedOf(*read.port)),
                   {},
                   tree_.pathOf(read.origin.node)});
  }

  static std::string nameOf(const EntryRead& read) { return read.owner + "." + read.port->name; }
  std::string nameOf(std::size_t slot) const { return "{" + tree_.slots[slot].name + "}"; }

  const TreeParts& tree_;
  Problems& problems_;
  const ParseOptions& options_;
  std::set<std::pair<std::size_t, const PortManifest*>> judged_;
};

}  // namespace

void checkEntries(const TreeParts& tree, Problems& problems, const ParseOptions& options) {
  EntryChecker checker(tree, problems, options);
  for (std::size_t i = 0; i < tree.slots.size() && !problems.full(); ++i)
    if (!tree.flows[i].reads.empty()) checker.check(i);
}

std::vector<std::size_t> TreeParts::sourcesOf(std::size_t slot) const {
  std::vector<std::size_t> reached = {slot};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const std::size_t from : flows[reached[i]].copied_from) {
      if (reached.size() == kMaxCopies) return reached;
      if (std::find(reached.begin(), reached.end(), from) == reached.end()) reached.push_back(from);
    }
  return reached;
}

const std::vector<Value>& TreeParts::valuesOf(std::size_t slot, const PortManifest& port) const {
  const auto [known, is_new] = values_.try_emplace({slot, &port});
  if (!is_new) return known->second;
  for (const std::size_t source : sourcesOf(slot))
    for (const LiteralWrite& literal : flows[source].literals)
      if (auto value = readValue(port, literal.text).value) known->second.push_back(std::move(*value));
  return known->second;
}

bool TreeParts::isOnlyWrittenAsText(std::size_t slot) const {
  const std::vector<std::size_t> sources = sourcesOf(slot);
  return sources.size() < kMaxCopies && std::all_of(sources.begin(), sources.end(), [&](std::size_t source) {
           const EntryFlow& flow = flows[source];
           return flow.typed_writes.empty() && !flow.by_host && !flow.is_unset;
         });
}

}  // namespace swiftlet::tree
