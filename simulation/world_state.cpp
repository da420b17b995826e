#include "simulation/world_state.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sdf/Actor.hh>
#include <sdf/Light.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>

#include "common/misleading.hpp"
#include "simulation/sdf_math.hpp"
#include "simulation/sdf_sources.hpp"

namespace swiftlet::simulation {
namespace {

using common::Message;

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

std::string nameOf(const sdf::ElementPtr& element) { return element->Get<std::string>("name"); }

/// A name in the scope "outer::", which may be written out.
std::string scoped(const std::string& scope, const std::string& name) {
  return name.starts_with(scope) ? name : scope + name;
}

/// What a <state> can name, each as "model::nested::link".
struct Names {
  std::vector<std::string> models;
  std::vector<std::string> links;
  std::vector<std::string> others;  ///< Names without a model to be placed: lights, actors and models that were added.
  std::set<std::string> stand_ins;  ///< Models whose parts are not known.
};

void addNames(const sdf::Model& model, const std::string& scope, Names& names) {
  const std::string name = scope + model.Name();
  names.models.push_back(name);
  if (model.LinkByName(kStandInLink) != nullptr) names.stand_ins.insert(name);
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i)
    names.links.push_back(name + "::" + model.LinkByIndex(i)->Name());
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) addNames(*model.ModelByIndex(i), name + "::", names);
}

Names namesOf(const sdf::World& world, const std::vector<sdf::ElementPtr>& inserted) {
  Names names;
  for (std::uint64_t i = 0; i < world.ModelCount(); ++i) addNames(*world.ModelByIndex(i), "", names);
  for (std::uint64_t i = 0; i < world.LightCount(); ++i) names.others.push_back(world.LightByIndex(i)->Name());
  for (std::uint64_t i = 0; i < world.ActorCount(); ++i) names.others.push_back(world.ActorByIndex(i)->Name());
  for (const auto& model : inserted) names.others.push_back(nameOf(model));
  return names;
}

bool among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

class StateReader {
 public:
  StateReader(const std::string& file, Names names, WorldState& state)
      : file_(file), names_(std::move(names)), state_(state) {}

  /// `scope` is the scope of the models around it, "outer::inner::".
  void addModel(const sdf::ElementPtr& model, const std::string& scope) {
    const std::string name = scoped(scope, nameOf(model));
    state_.entities[name] = stateOf(model);
    if (among(names_.others, name)) return;
    if (!among(names_.models, name)) return warn(model, "model", nameOf(model), scope);
    if (names_.stand_ins.contains(name)) return;
    for (const auto& link : childrenOf(model, "link")) addLink(link, name + "::");
    for (const auto& nested : childrenOf(model, "model")) addModel(nested, name + "::");
  }

  void addDeletion(const sdf::ElementPtr& element) {
    const auto name = element->Get<std::string>();
    state_.deleted.insert(name);
    if (!among(names_.models, name) && !among(names_.others, name)) warn(element, "model", name, "");
  }

 private:
  void addLink(const sdf::ElementPtr& link, const std::string& scope) {
    const std::string name = scoped(scope, nameOf(link));
    state_.entities[name] = stateOf(link);
    if (!among(names_.links, name)) warn(link, "link", nameOf(link), scope);
  }

  void warn(const sdf::ElementPtr& element, std::string_view kind, const std::string& name, const std::string& scope) {
    const std::string around = scope.empty() ? "the world" : "`" + scope.substr(0, scope.size() - 2) + "`";
    state_.warnings.push_back(
        {locationOf(element, file_), "state",
         Message("state.nothing-of-that-name", "{} has no {} `{}`, so this has no effect", around, kind, name),
         hintFor(name, scope, kind == "link" ? names_.links : names_.models)});
  }

  /// A name that is like it, or those that are there if they are few.
  static std::string hintFor(const std::string& name, const std::string& scope, const std::vector<std::string>& all) {
    if (std::string hint = common::misleadingHint(name); !hint.empty()) return hint;
    std::vector<std::string> there;
    for (const std::string& one : all)
      if (one.starts_with(scope)) there.push_back(one.substr(scope.size()));
    constexpr std::size_t kFew = 8;
    const std::string similar = common::didYouMean(name, there);
    if (!similar.empty() || there.empty() || there.size() > kFew) return similar;
    return fmt::format("there is {}", fmt::join(there, ", "));
  }

  const std::string& file_;
  Names names_;
  WorldState& state_;
};

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
    state.warnings.push_back(
        {locationOf(next, file), "state",
         Message("state.further", "the first <state>, of line {}, counts; this one is left out", state.source.line),
         ""});
  std::vector<sdf::ElementPtr> inserted;
  for (const auto& insertions : childrenOf(element, "insertions"))
    for (const auto& model : childrenOf(insertions, "model")) inserted.push_back(model);
  for (const auto& model : inserted)
    state.insertions.push_back({locationOf(model, file), "state",
                                Message("state.insertion", "models that were inserted are not read"),
                                "move this <model> out of <state>, into the <world>"});
  StateReader reader(file, namesOf(world, inserted), state);
  for (const auto& model : childrenOf(element, "model")) reader.addModel(model, "");
  for (const auto& deletions : childrenOf(element, "deletions"))
    for (const auto& name : childrenOf(deletions, "name")) reader.addDeletion(name);
  return state;
}

}  // namespace swiftlet::simulation
