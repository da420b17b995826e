#include "behaviors/mission_warnings.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <variant>

#include "behaviors/flight_order.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/tree/outcomes.hpp"

namespace swiftlet::behaviors {
namespace {

/// Worktops and bars end up to here. Who flies higher flies above shelves and half-high cabinets, on which things
/// stand.
constexpr double kFurniture_m = 1.1;

constexpr const char* kOperatorHint = "fly with the page, or give the trial an `operator` script";

class Warnings {
 public:
  Warnings(const tree::Tree& tree, const MissionLimits& limits)
      : tree_(tree), limits_(limits), unreached_(tree::unreachedNodes(tree, missionOutcomes(tree))) {}

  std::vector<tree::Problem> find() {
    for (const tree::Unreached& node : unreached_)
      warn(node.node, tree::Message("mission.unreached", "is never reached: {}", node.why));
    for (const tree::NodeRecord& record : tree_.nodes())
      if (typeNameOf(record).starts_with("Parallel")) checkParallel(*record.node);
    checkLanding();
    for (const tree::NodeRecord& record : tree_.nodes())
      if (typeNameOf(record) == "TakeOff") checkHeight(record);
    return findOfOperator();
  }

  std::vector<tree::Problem> findOfOperator() {
    for (const tree::NodeRecord& record : tree_.nodes()) {
      const LeafTraits traits = traitsOf(record);
      if (isUnreached(record.node->id())) continue;
      if (traits.obeys_operator && !limits_.operator_gives_goals)
        warn(record.node->id(),
             tree::Message("mission.nobody-gives-goals", "nobody gives it a goal, and the vehicle holds here"),
             kOperatorHint);
      if (traits.asks_operator && !limits_.operator_goes_on)
        warn(record.node->id(),
             tree::Message("mission.nobody-goes-on", "nobody says `go on`, and it {}", endOfWaiting(record)),
             kOperatorHint);
    }
    return std::move(warnings_);
  }

 private:
  void warn(int node, tree::Message message, std::string hint = {}) {
    const tree::NodeRecord& record = tree_.nodes()[static_cast<std::size_t>(node)];
    warnings_.push_back({tree_.locationOf(node), std::string(typeNameOf(record)), std::move(message), std::move(hint),
                         tree_.pathOf(node)});
  }

  bool mayBeUnlimited(int node, std::string_view port) const {
    const std::vector<tree::Value> limits = tree_.knownValues(node, port);
    return std::find(limits.begin(), limits.end(), tree::Value(tree::Duration{})) != limits.end();
  }

  std::string endOfWaiting(const tree::NodeRecord& waiter) const {
    if (!mayBeUnlimited(waiter.node->id(), "timeout_s")) return "fails after its timeout_s";
    bool may_be_halted = false;
    for (int id = waiter.parent; id >= 0; id = tree_.nodes()[static_cast<std::size_t>(id)].parent) {
      const std::string_view type = typeNameOf(tree_.nodes()[static_cast<std::size_t>(id)]);
      if (type == "Timeout" && !mayBeUnlimited(id, "msec")) return "waits until the Timeout above it ends it";
      may_be_halted |= type.starts_with("Reactive") || type.starts_with("Parallel") || type == "WhileDoElse";
    }
    return may_be_halted ? "waits until something else ends it" : "waits without an end";
  }

  /// The first leaf below that is active whenever it is ticked; null without one.
  const tree::Node* flyingLeafIn(const tree::Node& node) const {
    if (traitsOf(tree_.nodes()[static_cast<std::size_t>(node.id())]).vehicle != VehicleUse::kNone) return &node;
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
         tree::Message("mission.two-fly", "`{}` and `{}` fly in the same tick, and only the last intent is flown",
                       flying[0], flying[1]),
         "let one child fly and the others watch");
  }

  /// A vehicle above the furniture meets what stands on it, such as a book on a shelf.
  void checkHeight(const tree::NodeRecord& take_off) {
    for (const tree::Value& value : tree_.knownValues(take_off.node->id(), "height_m")) {
      const double* height_m = std::get_if<double>(&value);
      if (height_m == nullptr || limits_.unseen_below_m <= 0.0) continue;
      const double bottom_m = *height_m - limits_.unseen_below_m;
      if (bottom_m < kFurniture_m) continue;
      return warn(
          take_off.node->id(),
          tree::Message("mission.unseen-below",
                        "the hull is between {:.2f} and {:.2f} m, where no sensor sees what ends there, such as "
                        "a book on a shelf",
                        bottom_m, *height_m),
          "fly where nothing ends at that height, or with a profile that has an rgbd_camera");
    }
  }

  bool isUnreached(int id) const {
    for (; id >= 0; id = tree_.nodes()[static_cast<std::size_t>(id)].parent)
      if (std::any_of(unreached_.begin(), unreached_.end(), [&](const tree::Unreached& u) { return u.node == id; }))
        return true;
    return false;
  }

  void checkLanding() {
    for (const tree::NodeRecord& record : tree_.nodes()) {
      const LeafTraits traits = traitsOf(record);
      const bool lands = traits.vehicle == VehicleUse::kLands || traits.obeys_operator;
      if (!lands || isUnreached(record.node->id())) continue;
      if (mayEndInTheAir(tree_))
        warn(0, tree::Message("mission.ends-in-the-air", "the mission may succeed while the vehicle is in the air"),
             "end it with a <Land/>");
      return;
    }
    warn(0, tree::Message("mission.no-landing", "the mission never lands"), "end it with a <Land/>");
  }

  const tree::Tree& tree_;
  const MissionLimits& limits_;
  std::vector<tree::Unreached> unreached_;
  std::vector<tree::Problem> warnings_;
};

}  // namespace

std::vector<tree::Problem> missionWarnings(const tree::Tree& tree, const MissionLimits& limits) {
  return Warnings(tree, limits).find();
}

std::vector<tree::Problem> operatorWarnings(const tree::Tree& tree, const MissionLimits& limits) {
  return Warnings(tree, limits).findOfOperator();
}

}  // namespace swiftlet::behaviors
