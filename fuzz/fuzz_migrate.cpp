// links: tree
// Any bytes as a tree file of version 3, and as one whose parameters are changed. What is rewritten must still be XML,
// must be of version 4, and a second time there is nothing to do. What can be read is ticked for a while.
#include <cstdint>
#include <optional>
#include <string>

#include "behaviors/tree/migrate.hpp"
#include "behaviors/tree/outcome_script.hpp"
#include "behaviors/tree/outcomes.hpp"
#include "behaviors/tree/parameters.hpp"
#include "behaviors/tree/parser.hpp"

using namespace swiftlet::tree;

namespace {

/// What is read can be judged, shown and ticked.
void readAndTick(const std::string& text, const Registry& registry) {
  ParseOptions options;
  options.limits.nodes = 2'000;
  options.read_file = [](const std::string&) { return std::nullopt; };
  ParseResult parsed = parseText(text, "fuzz.xml", registry, options);
  if (parsed.tree.has_value() != parsed.problems.empty()) __builtin_trap();
  for (const Problem& problem : parsed.problems) (void)toString(problem);
  if (!parsed.tree) return;
  const std::vector<Outcomes> outcomes = outcomesOf(*parsed.tree);
  for (const Unreached& node : unreachedNodes(*parsed.tree, outcomes)) (void)parsed.tree->pathOf(node.node);
  TickContext context;
  for (int tick = 0; tick < 16; ++tick) {
    context.now_ns += 100'000'000;
    (void)parsed.tree->tick(context);
  }
  for (const NodeView& node : parsed.tree->view()) (void)parsed.tree->portsOf(node.id);
  while (parsed.tree->halt(context) == Release::kLettingGo) {}
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const Migration migration = migrateToVersion4(text, "fuzz.xml");
  if (migration.problems.empty()) {
    const Migration again = migrateToVersion4(migration.text, "fuzz.xml");
    if (!again.problems.empty() || !again.changes.empty() || again.text != migration.text) __builtin_trap();
  }
  static const Registry kRegistry = [] {
    Registry registry = Registry::standard();
    registry.add({.id = "Go", .kind = NodeKind::kAction, .ports = {{.name = "goal"}, {.name = "height_m"}}},
                 registry.find("AlwaysSuccess")->build);
    return registry;
  }();
  std::map<std::string, std::string> values;
  for (const Parameter& parameter : parametersOf(text, "fuzz.xml", kRegistry)) values[parameter.key] = "a\"<&'b";
  const Changed changed = withParameters(text, "fuzz.xml", kRegistry, values);
  for (const Parameter& parameter : parametersOf(changed.text, "fuzz.xml", kRegistry))
    if (values.contains(parameter.key) && parameter.value != "a\"<&'b") __builtin_trap();
  (void)readOutcomeScript(text, "fuzz.txt");
  readAndTick(migration.problems.empty() ? migration.text : text, kRegistry);
  return 0;
}
