// Relocalize: forgets the pose in the given map, turns about once where it is and, until the vehicle is localized,
// flies to free places around and back.
//
//   forget --> turn by 120 deg, three times --> fly out, fly back, in four directions --> FAILURE
//                    |                               |
//                    +------> localized: SUCCESS <---+
//
// FAILURE without a given map, in a map that is found to be that of another place, and after the last of these.
#include "behaviors/leaves.hpp"

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/ports.hpp"
#include "common/goal.hpp"
#include "common/world.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

using tree::PortType;
using tree::Status;

class Relocalize final : public FlightLeaf {
 public:
  explicit Relocalize(const tree::NodeSetup& setup)
      : FlightLeaf(setup), clearance_m_(setup, "clearance_m"), radius_m_(setup, "radius_m") {}
  static tree::NodeManifest manifest();

 private:
  tree::Status act(tree::TickContext& context) override;
  void onStart(tree::TickContext& context) override;
  void planLooks(const FlightTick& tick, double clearance_m, double radius_m);
  void nextLook(const FlightTick& tick);
  /// What is flown now; null after the last look.
  const common::GoToIntent* flown() const;

  struct Look {
    common::GoToIntent out;
    bool returns = false;  ///< It ends with the flight back; a turn where the vehicle is does not.
  };

  tree::Input<double> clearance_m_, radius_m_;
  std::uint64_t request_id_ = 0;  ///< 0 before it has asked.
  bool forgotten_ = false;
  std::vector<Look> looks_;
  std::size_t look_ = 0;     ///< The place that is being flown to.
  bool flies_back_ = false;  ///< It flies back from that place.
  common::GoToIntent back_;  ///< To where the vehicle began.
};

/// The places about the vehicle need little precision: a gust must not keep it at one.
constexpr double kTolerance_m = 0.15;
constexpr int kTurns = 3;       ///< A laser sees 240 to 270 degrees; three turns show all of it twice.
constexpr int kDirections = 4;  ///< In a corridor two of them are free.

tree::NodeManifest Relocalize::manifest() {
  return {
      .id = "Relocalize",
      .kind = tree::NodeKind::kAction,
      .ports = {clearancePort(),
                {.name = "radius_m",
                 .type = PortType::kDouble,
                 .default_value = "1.5",
                 .minimum = 0.5,
                 .maximum = 10.0,
                 .description = "Distance from where the vehicle began that it flies to see more."}},
      .description = "Looks around for its place in the given map, as if it did not know it.",
      .details =
          "It turns about once and then flies out by `radius_m` and back in up to four directions that are free, until "
          "the place is known.",
      .ends = "SUCCESS when it is; FAILURE without a given map, in that of another place, or after the last direction",
      .traits = LeafTraits{.map = MapUse::kNeeds}};
}

void Relocalize::onStart(tree::TickContext& context) {
  FlightLeaf::onStart(context);
  request_id_ = 0;
  forgotten_ = false;
  looks_.clear();
  look_ = 0;
  flies_back_ = false;
}

/// Straight ahead first: what is there has been seen best.
void Relocalize::planLooks(const FlightTick& tick, double clearance_m, double radius_m) {
  const common::Pose2 T_map_body = tick.flight.world->vehicle->state.T_map_body_planar();
  common::GoToIntent look;
  look.goal_map_m = T_map_body.position_m();
  look.tolerance_m = kTolerance_m;
  look.mode = tick.mode;
  look.clearance_m = 0.0;  // It is here already.
  for (int i = 1; i <= kTurns; ++i) {
    look.yaw_map_rad = common::wrapAngle(T_map_body.yaw_rad + i * 2.0 * std::numbers::pi / kTurns);
    looks_.push_back({look, false});
  }
  back_ = look;
  back_.yaw_map_rad.reset();
  for (int i = 0; i < kDirections; ++i) {
    common::GoToIntent out = back_;
    const Eigen::Rotation2Dd turned(i * 2.0 * std::numbers::pi / kDirections);
    out.goal_map_m = T_map_body * (turned * Eigen::Vector2d(radius_m, 0.0));
    out.clearance_m = clearance_m;
    looks_.push_back({out, true});
  }
}

const common::GoToIntent* Relocalize::flown() const {
  if (look_ >= looks_.size()) return nullptr;
  return flies_back_ ? &back_ : &looks_[look_].out;
}

/// Leaves out the places that the map says are not free.
void Relocalize::nextLook(const FlightTick& tick) {
  renewIntent();
  if (looks_[look_].returns && !flies_back_) {
    flies_back_ = true;
    return;
  }
  const auto isFree = [&](const common::GoToIntent& out) {
    return common::judgeGoal(common::goalOf(out), tick.flight.goal_limits, tick.flight.goal_map.get()).has_value();
  };
  flies_back_ = false;
  ++look_;
  while (look_ < looks_.size() && looks_[look_].returns && !isFree(looks_[look_].out)) ++look_;
}

Status Relocalize::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  const auto& localization = tick.flight.world->map->localization;
  if (!localization) return fail(context, "the flight was given no map");
  const auto clearance_m = clearance_m_.get(), radius_m = radius_m_.get();
  if (!clearance_m) return fail(context, clearance_m_.problem());
  if (!radius_m) return fail(context, radius_m_.problem());
  if (request_id_ == 0) request_id_ = tick.request(common::RelocalizeRequest{});
  if (!forgotten_) {
    emitHold(tick);
    const auto answer = tick.takeAnswer(request_id_);
    if (!answer) return Status::kRunning;
    if (!answer->done) return fail(context, answer->reason);
    forgotten_ = true;
    planLooks(tick, *clearance_m, *radius_m);
  }
  if (localization->localized()) return Status::kSuccess;
  if (localization->refuted) return fail(context, "the given map does not match this place");
  if (flown() != nullptr) emitIntent(tick, *flown());
  if (intentState(tick) != common::IntentState::kRunning) nextLook(tick);
  if (flown() != nullptr) {
    emitIntent(tick, *flown());
    return Status::kRunning;
  }
  return fail(context, fmt::format("looked around, and the place is still {}", toString(localization->state)));
}

}  // namespace

void addRelocalize(tree::Registry& registry) { registry.add<Relocalize>(); }

}  // namespace swiftlet::behaviors
