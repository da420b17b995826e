#include "behaviors/tree/registry.hpp"

#include <utility>

#include "behaviors/tree/nodes/always.hpp"
#include "behaviors/tree/nodes/delay.hpp"
#include "behaviors/tree/nodes/fallback.hpp"
#include "behaviors/tree/nodes/force_failure.hpp"
#include "behaviors/tree/nodes/force_success.hpp"
#include "behaviors/tree/nodes/inverter.hpp"
#include "behaviors/tree/nodes/parallel.hpp"
#include "behaviors/tree/nodes/priority.hpp"
#include "behaviors/tree/nodes/reactive_fallback.hpp"
#include "behaviors/tree/nodes/reactive_sequence.hpp"
#include "behaviors/tree/nodes/repeat.hpp"
#include "behaviors/tree/nodes/retry_until_successful.hpp"
#include "behaviors/tree/nodes/sequence.hpp"
#include "behaviors/tree/nodes/set_blackboard.hpp"
#include "behaviors/tree/nodes/timeout.hpp"

namespace swiftlet::tree {

Registry Registry::standard() {
  Registry registry;
  registry.add<Sequence>();
  registry.add<Fallback>();
  registry.add<ReactiveSequence>();
  registry.add<ReactiveFallback>();
  registry.add<Parallel>();
  registry.add<Priority>();
  registry.add<Inverter>();
  registry.add<ForceSuccess>();
  registry.add<ForceFailure>();
  registry.add<Repeat>();
  registry.add<RetryUntilSuccessful>();
  registry.add<Timeout>();
  registry.add<Delay>();
  registry.add<AlwaysSuccess>();
  registry.add<AlwaysFailure>();
  registry.add<SetBlackboard>();
  return registry;
}

void Registry::add(NodeManifest manifest, NodeBuilder build) {
  const std::string id = manifest.id;
  types_.insert_or_assign(id, NodeType{std::move(manifest), std::move(build)});
}

const NodeType* Registry::find(std::string_view id) const {
  const auto found = types_.find(id);
  return found == types_.end() ? nullptr : &found->second;
}

std::vector<std::string> Registry::ids() const {
  std::vector<std::string> ids;
  for (const auto& [id, type] : types_) ids.push_back(id);
  return ids;
}

}  // namespace swiftlet::tree
