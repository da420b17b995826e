// swiftlet nodes: the node types of missions, for people and editors.
#include <memory>
#include <string>
#include <vector>

#include "apps/command.hpp"
#include "apps/show.hpp"
#include "behaviors/tree/problem.hpp"
#include "flight/leaf_libraries.hpp"

namespace swiftlet::apps {
namespace {

struct NodesOptions {
  std::vector<std::string> names;
  std::vector<std::string> leaves;
  bool xml = false;
  bool xsd = false;
  bool markdown = false;
};

/// All nodes that are named, or all names that are no node's.
int printNamed(const std::vector<std::string>& names, const tree::Registry& registry) {
  std::string help, problems;
  std::vector<std::string> known = registry.ids();
  known.push_back(tree::subTreeManifest().id);
  for (const std::string& name : names) {
    if (const tree::NodeType* type = registry.find(name))
      help += tree::writeNodeHelp(type->manifest);
    else if (name == tree::subTreeManifest().id)
      help += tree::writeNodeHelp(tree::subTreeManifest());
    else {
      const std::string similar = tree::didYouMean(name, known);
      problems += toString(tree::Problem{{},
                                         "nodes",
                                         tree::Message("nodes.unknown", "unknown node `{}`", name),
                                         similar.empty() ? "`swiftlet nodes` lists all" : similar}) +
                  "\n";
    }
  }
  show(help);
  showError(problems);
  return problems.empty() ? kDone : kBadInput;
}

int printNodes(const NodesOptions& options) {
  const int forms = int{options.xml} + int{options.xsd} + int{options.markdown};
  if (forms > 1 || (forms == 1 && !options.names.empty())) {
    showError("nodes: expected names of nodes, or one of --xml, --xsd and --markdown\n");
    return kBadInput;
  }
  const behaviors::NodeTypes types = flight::nodesWith(options.leaves);
  const tree::Registry& registry = *types;
  if (!options.names.empty()) return printNamed(options.names, registry);
  show(options.xml        ? tree::writeTreeNodesModel(registry)
       : options.xsd      ? tree::writeSchema(registry)
       : options.markdown ? tree::writeNodeTable(registry)
                          : tree::writeNodeList(registry));
  return kDone;
}

}  // namespace

void addNodes(Command& program) {
  auto options = std::make_shared<NodesOptions>();
  Command command = program.command("nodes", "Print the node types of missions, or the ports of those that are named.");
  command.optionalArguments("nodes", options->names,
                            "Nodes of which to print each port with unit, bounds and meaning.");
  command.leavesOption(options->leaves);
  command.flag("--xml", options->xml, "The palette that Groot2 loads: missions/groot2/palette.xml.");
  command.flag("--xsd", options->xsd, "A schema for other editors: missions/swiftlet.xsd.");
  command.flag("--markdown", options->markdown, "A table with bounds and defaults: docs/nodes.md.");
  command.footer("Example: swiftlet nodes MoveToGoal Photograph");
  command.runs([options] { return printNodes(*options); });
}

}  // namespace swiftlet::apps
