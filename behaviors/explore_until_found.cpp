// ExploreUntilFound: explores until `count` targets of a name are found, and then looks with the camera at what it has
// not seen yet. SUCCESS when they are found; FAILURE when nothing is left to look at, or when exploring fails.
//
//   explore --nothing left--> look at the nearest unseen place --> at the next ... --nothing left--> FAILURE
//       \-------- enough found, the vehicle has stopped -------/ --> SUCCESS
#include "behaviors/leaves.hpp"

#include <cstdint>
#include <string>

#include "behaviors/explore_ports.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/looking_leaf.hpp"
#include "behaviors/target_ports.hpp"
#include "common/world.hpp"

namespace swiftlet::behaviors {
namespace {

using tree::Status;

class ExploreUntilFound final : public LookingLeaf {
 public:
  explicit ExploreUntilFound(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  void onStart(tree::TickContext& context) override;
  tree::Status act(tree::TickContext& context) override;
  /// Empty while exploring continues; else why it has failed.
  std::string explore(FlightTick& tick, const common::ExploreIntent& intent);

  tree::Input<std::string> name_;
  tree::Input<std::int64_t> count_;
  tree::Input<double> range_m_;
  ExplorePorts ports_;
  bool explored_ = false;
};

tree::NodeManifest ExploreUntilFound::manifest() {
  tree::NodeManifest manifest{
      .id = "ExploreUntilFound",
      .kind = tree::NodeKind::kAction,
      .ports = {targetNamePort(), targetCountPort(), rangePort()},
      .description = "Explores, and looks at everything with the camera, until targets are found.",
      .details =
          "It explores until `count` targets of that name are found (any, without a name), and then looks at every "
          "free place that the camera has not seen from within `range_m`.",
      .ends =
          "SUCCESS when they are found and the vehicle has stopped; FAILURE when nothing is left to look at, or when "
          "exploring fails",
      .traits = LeafTraits{.needs_camera = true, .about_targets = true}};
  for (tree::PortManifest& port : ExplorePorts::manifests()) manifest.ports.push_back(std::move(port));
  return manifest;
}

ExploreUntilFound::ExploreUntilFound(const tree::NodeSetup& setup)
    : LookingLeaf(setup), name_(setup, "target"), count_(setup, "count"), range_m_(setup, "range_m"), ports_(setup) {}

void ExploreUntilFound::onStart(tree::TickContext& context) {
  LookingLeaf::onStart(context);
  explored_ = false;
}

Status ExploreUntilFound::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  const auto name = name_.get();
  const auto count = count_.get();
  const auto range_m = range_m_.get();
  const auto intent = ports_.intent(tick.mode, *tick.flight.world);
  if (!name) return fail(context, name_.problem());
  if (!count) return fail(context, count_.problem());
  if (!range_m) return fail(context, range_m_.problem());
  if (!intent) return fail(context, intent.error());
  see(tick, *range_m);
  const std::int64_t found = countFound(*tick.flight.world->targets, *name);
  if (found >= *count) {
    emitHold(tick);
    return holdReleased(tick) ? Status::kSuccess : Status::kRunning;
  }
  if (!explored_) {
    const std::string problem = explore(tick, *intent);
    if (!problem.empty()) return fail(context, problem);
  }
  if (explored_ && !lookOn(tick, {*range_m, intent->clearance_m, intent->bounds, intent->leave_building}))
    return fail(context, foundText(found, *count, *name) + ", and nothing is left to look at");
  return Status::kRunning;
}

std::string ExploreUntilFound::explore(FlightTick& tick, const common::ExploreIntent& intent) {
  emitIntent(tick, intent);
  const common::IntentState state = intentState(tick);
  explored_ = state == common::IntentState::kSucceeded;
  if (explored_) renewIntent();
  return state == common::IntentState::kFailed ? tick.flight.status.reason : std::string();
}

}  // namespace

void addExploreUntilFound(tree::Registry& registry) { registry.add<ExploreUntilFound>(); }

}  // namespace swiftlet::behaviors
