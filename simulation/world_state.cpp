#include "simulation/world_state.hpp"

#include "simulation/sdf_math.hpp"

namespace swiftlet::simulation {
namespace {

std::vector<sdf::ElementPtr> childrenOf(const sdf::ElementPtr& element, const std::string& name) {
  std::vector<sdf::ElementPtr> children;
  if (!element->HasElement(name)) return children;
  for (auto child = element->GetElement(name); child; child = child->GetNextElement(name)) children.push_back(child);
  return children;
}

EntityState stateOf(const sdf::ElementPtr& element) {
  EntityState state;
  if (element->HasElement("pose")) {
    const auto pose = element->Get<ignition::math::Pose3d>("pose");
    if (pose.IsFinite()) state.T_world_entity = toPose(pose);
  }
  if (element->HasElement("scale")) state.scale = toEigen(element->Get<ignition::math::Vector3d>("scale"));
  return state;
}

void addModel(const sdf::ElementPtr& model, const std::string& scope, WorldState& world) {
  const std::string name = scope + model->Get<std::string>("name");
  world.entities[name] = stateOf(model);
  for (const auto& link : childrenOf(model, "link"))
    world.entities[name + "::" + link->Get<std::string>("name")] = stateOf(link);
  for (const auto& nested : childrenOf(model, "model")) addModel(nested, name + "::", world);
}

}  // namespace

const EntityState* WorldState::of(const std::string& name) const {
  const auto found = entities.find(name);
  return found == entities.end() ? nullptr : &found->second;
}

WorldState readState(const sdf::World& world, const std::string& file) {
  WorldState state;
  if (!world.Element() || !world.Element()->HasElement("state")) return state;
  const sdf::ElementPtr element = world.Element()->GetElement("state");
  state.source = locationOf(element, file);
  for (auto next = element->GetNextElement("state"); next; next = next->GetNextElement("state"))
    state.unused.push_back(locationOf(next, file));
  for (const auto& model : childrenOf(element, "model")) addModel(model, "", state);
  for (const auto& deletions : childrenOf(element, "deletions"))
    for (const auto& name : childrenOf(deletions, "name")) state.deleted.insert(name->Get<std::string>());
  for (const auto& insertions : childrenOf(element, "insertions"))
    for (const auto& model : childrenOf(insertions, "model"))
      state.insertions.push_back({locationOf(model, file), "state", "models that were inserted are not read",
                                  "move this <model> out of <state>, into the <world>"});
  return state;
}

}  // namespace swiftlet::simulation
