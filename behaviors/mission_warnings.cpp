#include "behaviors/mission_warnings.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/flight_order.hpp"
#include "behaviors/tree/outcomes.hpp"

namespace swiftlet::behaviors {
namespace {

std::optional<tree::Outcomes> outcomesOfLeaf(const tree::Tree& tree, const tree::NodeRecord& leaf) {
  if (typeNameOf(leaf) == "LogEvent") return tree::Outcomes{.success = true};
  if (neverSucceeds(tree, leaf)) return tree::Outcomes{.failure = true};
  return std::nullopt;
}

class Warnings {
 public:
  explicit Warnings(const tree::Tree& tree) : tree_(tree) {}

  std::vector<tree::Problem> find() {
    const auto outcomes =
        tree::outcomesOf(tree_, [this](const tree::NodeRecord& leaf) { return outcomesOfLeaf(tree_, leaf); });
    const std::vector<tree::Unreached> unreached = tree::unreachedNodes(tree_, outcomes);
    for (const tree::Unreached& node : unreached) warn(node.node, "is never reached: " + node.why, {});
    for (const tree::NodeRecord& record : tree_.nodes())
      if (typeNameOf(record).starts_with("Parallel")) checkParallel(*record.node);
    checkLanding(unreached);
    return std::move(warnings_);
  }

 private:
  void warn(int node, std::string message, std::string hint) {
    const tree::NodeRecord& record = tree_.nodes()[static_cast<std::size_t>(node)];
    warnings_.push_back({tree_.locationOf(node), std::string(typeNameOf(record)), std::move(message), std::move(hint),
                         tree_.pathOf(node)});
  }

  /// The first leaf below that has the vehicle whenever it is ticked; null without one.
  const tree::Node* flyingLeafIn(const tree::Node& node) const {
    const tree::NodeManifest* manifest = tree_.nodes()[static_cast<std::size_t>(node.id())].manifest;
    if (dynamic_cast<const FlightLeaf*>(&node) != nullptr && manifest != nullptr && !manifest->may_skip) return &node;
    for (const auto& child : node.children())
      if (const tree::Node* leaf = flyingLeafIn(*child)) return leaf;
    return nullptr;
  }

  void checkParallel(const tree::Node& parallel) {
    std::vector<std::string> flying;
    for (const auto& child : parallel.children())
      if (const tree::Node* leaf = flyingLeafIn(*child)) flying.push_back(leaf->name());
    if (flying.size() < 2) return;
    warn(parallel.id(),
         "`" + flying[0] + "` and `" + flying[1] + "` fly in the same tick, and only the last intent is flown",
         "let one child fly and the others watch");
  }

  void checkLanding(const std::vector<tree::Unreached>& unreached) {
    const auto isUnreached = [&](int id) {
      for (; id >= 0; id = tree_.nodes()[static_cast<std::size_t>(id)].parent)
        if (std::any_of(unreached.begin(), unreached.end(), [&](const tree::Unreached& u) { return u.node == id; }))
          return true;
      return false;
    };
    for (const tree::NodeRecord& record : tree_.nodes()) {
      const std::string_view type = typeNameOf(record);
      const bool lands = type.find("Land") != std::string_view::npos || type == "OperatorCommand";
      if (!lands || isUnreached(record.node->id())) continue;
      if (mayEndInTheAir(tree_))
        warn(0, "the mission may succeed while the vehicle is in the air", "end it with a <Land/>");
      return;
    }
    warn(0, "the mission never lands", "end it with a <Land/>");
  }

  const tree::Tree& tree_;
  std::vector<tree::Problem> warnings_;
};

}  // namespace

std::vector<tree::Problem> missionWarnings(const tree::Tree& tree) { return Warnings(tree).find(); }

}  // namespace swiftlet::behaviors
