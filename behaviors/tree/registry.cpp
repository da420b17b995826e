#include "behaviors/tree/registry.hpp"

#include <utility>

#include "behaviors/tree/nodes/always.hpp"
#include "behaviors/tree/nodes/async_fallback.hpp"
#include "behaviors/tree/nodes/async_sequence.hpp"
#include "behaviors/tree/nodes/delay.hpp"
#include "behaviors/tree/nodes/entry_updated.hpp"
#include "behaviors/tree/nodes/fallback.hpp"
#include "behaviors/tree/nodes/force_failure.hpp"
#include "behaviors/tree/nodes/force_success.hpp"
#include "behaviors/tree/nodes/if_then_else.hpp"
#include "behaviors/tree/nodes/inverter.hpp"
#include "behaviors/tree/nodes/keep_running_until_failure.hpp"
#include "behaviors/tree/nodes/loop.hpp"
#include "behaviors/tree/nodes/parallel.hpp"
#include "behaviors/tree/nodes/parallel_all.hpp"
#include "behaviors/tree/nodes/precondition.hpp"
#include "behaviors/tree/nodes/priority.hpp"
#include "behaviors/tree/nodes/reactive_fallback.hpp"
#include "behaviors/tree/nodes/reactive_sequence.hpp"
#include "behaviors/tree/nodes/repeat.hpp"
#include "behaviors/tree/nodes/retry_until_successful.hpp"
#include "behaviors/tree/nodes/run_once.hpp"
#include "behaviors/tree/nodes/script_nodes.hpp"
#include "behaviors/tree/nodes/sequence.hpp"
#include "behaviors/tree/nodes/sequence_with_memory.hpp"
#include "behaviors/tree/nodes/set_blackboard.hpp"
#include "behaviors/tree/nodes/sleep.hpp"
#include "behaviors/tree/nodes/switch_node.hpp"
#include "behaviors/tree/nodes/test_node.hpp"
#include "behaviors/tree/nodes/timeout.hpp"
#include "behaviors/tree/nodes/try_catch.hpp"
#include "behaviors/tree/nodes/unset_blackboard.hpp"
#include "behaviors/tree/nodes/while_do_else.hpp"

namespace swiftlet::tree {

Registry Registry::standard() {
  Registry registry;
  registry.add<Sequence>();
  registry.add<Fallback>();
  registry.add<ReactiveSequence>();
  registry.add<ReactiveFallback>();
  registry.add<SequenceWithMemory>();
  registry.add<AsyncSequence>();
  registry.add<AsyncFallback>();
  registry.add<Parallel>();
  registry.add<ParallelAll>();
  registry.add<IfThenElse>();
  registry.add<WhileDoElse>();
  registry.add<TryCatch>();
  registry.add<Priority>();
  for (std::size_t cases = 2; cases <= 6; ++cases)
    registry.add(SwitchNode::manifest(cases),
                 [cases](const NodeSetup& setup) { return std::make_unique<SwitchNode>(setup, cases); });
  registry.add<Inverter>();
  registry.add<ForceSuccess>();
  registry.add<ForceFailure>();
  registry.add<KeepRunningUntilFailure>();
  registry.add<RunOnce>();
  registry.add<Precondition>();
  registry.add<SkipUnlessUpdated>();
  registry.add<WaitValueUpdate>();
  for (const auto& loop : {std::pair{"LoopDouble", PortType::kDouble}, std::pair{"LoopInt", PortType::kInt},
                           std::pair{"LoopBool", PortType::kBool}, std::pair{"LoopString", PortType::kString}})
    registry.add(Loop::manifest(loop.first, loop.second),
                 [element = loop.second](const NodeSetup& setup) { return std::make_unique<Loop>(setup, element); });
  registry.add<Repeat>();
  registry.add<RetryUntilSuccessful>();
  registry.add<Timeout>();
  registry.add<Delay>();
  registry.add<AlwaysSuccess>();
  registry.add<AlwaysFailure>();
  registry.add<SetBlackboard>();
  registry.add<UnsetBlackboard>();
  registry.add<WasEntryUpdated>();
  registry.add<ScriptNode>();
  registry.add<ScriptCondition>();
  registry.add<Sleep>();
  registry.add<TestNode>();
  return registry;
}

void Registry::add(NodeManifest manifest, NodeBuilder build) {
  for (const PortManifest& port : manifest.ports)
    for (std::size_t i = 0; i < port.choices.size(); ++i)
      addConstant(constantOf(port.choices[i]), static_cast<std::int64_t>(i));
  const std::string id = manifest.id;
  types_.insert_or_assign(id, NodeType{std::move(manifest), std::move(build)});
}

const NodeType* Registry::find(std::string_view id) const {
  const auto found = types_.find(id);
  return found == types_.end() ? nullptr : &found->second;
}

std::string constantOf(std::string choice) {
  for (char& c : choice) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return choice;
}

std::vector<std::string> Registry::ids() const {
  std::vector<std::string> ids;
  for (const auto& [id, type] : types_) ids.push_back(id);
  return ids;
}

}  // namespace swiftlet::tree
