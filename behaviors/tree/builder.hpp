// Makes the nodes of the main tree, subtrees expanded in place.
//
// Entries: each use of a tree has its own. A SubTree attribute `inner="{outer}"` makes both names one entry,
// `inner="text"` gives the inner entry that text, and `_autoremap="true"` maps every inner name that is not given to
// the outer entry of the same name, unless it starts with "_". `{@name}` is an entry of the main tree in every subtree.
// A port that <TreeNodesModel> declares with a default takes it if the attribute is missing.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "behaviors/tree/documents.hpp"
#include "behaviors/tree/registry.hpp"
#include "behaviors/tree/script/compiled_scripts.hpp"
#include "behaviors/tree/tree.hpp"
#include "behaviors/tree/tree_parts.hpp"

namespace swiftlet::tree {

class Builder {
 public:
  /// Takes the scripts that the Checker has compiled.
  Builder(const Documents& documents, const Registry& registry, const ParseOptions& options, Problems& problems,
          CompiledScripts& scripts);
  ~Builder();

  /// For documents in which Checker found no problem. The tree is valid if there is still none afterwards.
  Tree build();

 private:
  struct Scope;
  struct Place {
    const Document* document = nullptr;
    const XmlElement* element = nullptr;
    int parent = -1;
    int depth = 0;
  };

  std::unique_ptr<Node> makeNode(const Place& place, Scope& scope);
  std::unique_ptr<Node> makeSubTree(const Place& place, Scope& scope);
  std::unique_ptr<Node> makeTyped(const Place& place, Scope& scope);
  void bindSubTree(const Place& place, Scope& outer, Scope& inner);
  void checkUnused(const Place& place, const Scope& inner, const std::set<std::string>& passed);
  void bindPorts(const Place& place, Scope& scope, const NodeManifest& manifest, NodeSetup& setup);
  void recordFlow(const NodeOrigin& origin, const NodeManifest& manifest, const NodeSetup& setup);
  void recordRead(std::size_t slot, const NodeOrigin& origin, const std::string& owner, const PortManifest& port);
  std::shared_ptr<Conditions> makeConditions(const Place& place, Scope& scope, const std::string& owner);
  std::shared_ptr<Script> makeScript(const Place& place, Scope& scope, const std::string& owner,
                                     const PortManifest& port, const std::string& text);
  void recordWrites(const Script& script, const NodeOrigin& origin, const std::string& attribute);
  int addRecord(const Place& place, const NodeManifest* manifest);
  void finishRecord(int id, Node& node);
  Slot* find(Scope& scope, const std::string& name);
  Slot* makeSlot(const std::string& name);
  NodeOrigin originOf(const Place& place) const;
  bool tooLarge(const Place& place);

  const Documents& documents_;
  const Registry& registry_;
  const ParseOptions& options_;
  Problems& problems_;
  CompiledScripts& scripts_;
  std::unique_ptr<TreeParts> tree_;
  std::map<const Document*, std::size_t> files_;
  Scope* main_scope_ = nullptr;
  bool gave_up_ = false;
};

/// Entries that are read but never set, or set to a value that their readers cannot take.
void checkEntries(const TreeParts& tree, Problems& problems);

}  // namespace swiftlet::tree
