// swiftlet nodes: the node types of missions, for editors and people.
#include <memory>

#include "apps/command.hpp"
#include "apps/show.hpp"
#include "behaviors/registry.hpp"

namespace swiftlet::apps {
namespace {

struct NodesOptions {
  bool xml = false;
  bool xsd = false;
  bool markdown = false;
};

int printNodes(const NodesOptions& options) {
  if (int{options.xml} + int{options.xsd} + int{options.markdown} != 1) {
    showError("nodes: expected one of --xml, --xsd and --markdown\n");
    return kBadInput;
  }
  const tree::Registry& registry = behaviors::missionRegistry();
  show(options.xml   ? tree::writeTreeNodesModel(registry)
       : options.xsd ? tree::writeSchema(registry)
                     : tree::writeNodeTable(registry));
  return kDone;
}

}  // namespace

void addNodes(Command& program) {
  auto options = std::make_shared<NodesOptions>();
  Command command = program.command("nodes", "Print the node types of missions with their ports.");
  command.flag("--xml", options->xml, "The palette that Groot2 loads: missions/groot2/palette.xml.");
  command.flag("--xsd", options->xsd, "A schema for other editors: missions/swiftlet.xsd.");
  command.flag("--markdown", options->markdown, "A table with bounds and defaults: docs/nodes.md.");
  command.footer("Example: swiftlet nodes --xml");
  command.runs([options] { return printNodes(*options); });
}

}  // namespace swiftlet::apps
