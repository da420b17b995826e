// Makes the nodes of the main tree, subtrees expanded in place.
//
// Entries: each use of a tree has its own. A SubTree attribute `inner="{outer}"` makes both names one entry,
// `inner="text"` gives the inner entry that text, and `_autoremap="true"` maps every inner name that is not given to
// the outer entry of the same name, unless it starts with "_". `{@name}` is an entry of the main tree in every subtree.
// A port that <TreeNodesModel> declares with a default takes it if the attribute is missing.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "behaviors/tree/documents.hpp"
#include "behaviors/tree/flow_recorder.hpp"
#include "behaviors/tree/registry.hpp"
#include "behaviors/tree/tree.hpp"
#include "behaviors/tree/tree_parts.hpp"

namespace swiftlet::tree {

class Builder {
 public:
  /// Into `tree`, where the Checker has put the scripts.
  Builder(Documents& documents, const Registry& registry, const ParseOptions& options, Problems& problems,
          std::unique_ptr<TreeParts> tree);
  ~Builder();

  /// For documents in which Checker found no problem. The tree is valid if there is still none afterwards. It takes
  /// the files with it.
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
  void bindSubTree(const Place& place, Scope& outer, Scope& inner, int record);
  void checkUnused(const Place& place, const Scope& inner, int record);
  /// Of a node that may not be complete yet.
  void report(Problem problem, int node, bool is_warning = false);
  /// There is no need to look for more.
  bool foundEnough() const;
  void addFound();
  void bindPorts(const Place& place, Scope& scope, const NodeManifest& manifest, NodeSetup& setup);
  Conditions* makeConditions(const Place& place, Scope& scope, const std::string& owner);
  Script* scriptOf(const XmlAttribute& attribute);
  void bindScript(Script& script, const Place& place, Scope& scope, const std::string& owner, const PortManifest& port);
  int addRecord(const Place& place, const NodeManifest* manifest);
  void finishRecord(int id, Node& node);
  Slot* find(Scope& scope, std::string_view name);
  static bool isOwn(const Scope& scope, std::string_view name);
  Slot* makeSlot(std::string_view name);
  NodeOrigin originOf(const Place& place) const;
  bool tooLarge(const Place& place);

  Documents& documents_;
  const Registry& registry_;
  const ParseOptions& options_;
  Problems& problems_;
  std::unique_ptr<TreeParts> tree_;
  FlowRecorder flow_;
  Scope* main_scope_ = nullptr;
  struct Found {
    Problem problem;
    int node = -1;  ///< That it is about.
    bool is_warning = false;
  };
  std::vector<Found> found_;
  bool gave_up_ = false;
};

/// Entries that are read but never set, or set to a value that their readers cannot take. One that is never set is a
/// warning if the host may set it, and, leniently, if it may be a constant of another program (RED, of a script).
void checkEntries(const TreeParts& tree, Problems& problems, const ParseOptions& options);

/// Warns of scripts that compare or add texts that look like numbers.
void warnOfNumberTexts(const TreeParts& tree, Problems& problems);

}  // namespace swiftlet::tree
