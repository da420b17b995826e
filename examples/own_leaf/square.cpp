// Square: flies round a square and comes back to where it began.
#include <array>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_library.hpp"
#include "behaviors/ports.hpp"
#include "common/world.hpp"
#include "common/world/vehicle_layer.hpp"

namespace {

namespace behaviors = swiftlet::behaviors;
namespace common = swiftlet::common;
namespace tree = swiftlet::tree;

class Square final : public behaviors::FlightLeaf {
 public:
  explicit Square(const tree::NodeSetup& setup)
      : FlightLeaf(setup), side_m_(setup, "side_m"), clearance_m_(setup, "clearance_m"), mode_(setup, "mode") {}

  static tree::NodeManifest manifest() {
    return {.id = "Square",
            .ports = {{.name = "side_m",
                       .type = tree::PortType::kDouble,
                       .default_value = "1.0",
                       .minimum = 0.3,
                       .maximum = 10.0,
                       .description = "Length of a side; the first one leads ahead."},
                      behaviors::clearancePort(),
                      behaviors::modePort()},
            .description = "Flies round a square, counter-clockwise.",
            .ends = "SUCCESS where it began; FAILURE when a corner cannot be reached"};
  }

 private:
  void onStart(tree::TickContext& context) override {
    FlightLeaf::onStart(context);
    start_ = behaviors::flightTick(context).flight.world->vehicle->state.T_map_body_planar();
    corner_ = 0;
  }

  tree::Status act(tree::TickContext& context) override {
    constexpr std::array<std::array<double, 2>, 4> kCorners = {{{1, 0}, {1, 1}, {0, 1}, {0, 0}}};
    behaviors::FlightTick& tick = behaviors::flightTick(context);
    const auto side_m = side_m_.get();
    const auto clearance_m = clearance_m_.get();
    const auto mode = behaviors::modeOr(mode_, tick.mode);
    if (!side_m) return fail(context, side_m_.problem());
    if (!clearance_m) return fail(context, clearance_m_.problem());
    if (!mode) return fail(context, mode_.problem());
    if (intentState(tick) == common::IntentState::kFailed) return fail(context, tick.flight.status.reason);
    if (intentState(tick) == common::IntentState::kSucceeded) {
      ++corner_;
      renewIntent();
    }
    if (corner_ == kCorners.size()) return tree::Status::kSuccess;
    common::GoToIntent to_corner;
    to_corner.goal_map_m = start_ * Eigen::Vector2d(*side_m * kCorners[corner_][0], *side_m * kCorners[corner_][1]);
    to_corner.clearance_m = *clearance_m;
    to_corner.mode = *mode;
    emitIntent(tick, to_corner);
    return tree::Status::kRunning;
  }

  tree::Input<double> side_m_;
  tree::Input<double> clearance_m_;
  tree::Input<std::string> mode_;
  common::Pose2 start_;  ///< Where it began, in `map`.
  std::size_t corner_ = 0;
};

}  // namespace

extern "C" behaviors::LeafLibrary swiftlet_leaves() {
  return behaviors::leafLibrary([](tree::Registry& leaves) { leaves.add<Square>(); });
}
