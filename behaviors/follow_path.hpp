// FollowPath and Patrol: fly from point to point. Each leg is planned like any flight to a goal, so what is in the way
// is flown around. After an interruption the leg that was being flown is flown again.
//
// FollowPath is SUCCESS at the last point; the others are passed within corner_m, without a stop. Patrol visits every
// point, waits there, and starts over: SUCCESS after `rounds` rounds, never if `rounds` is 0. It skips a point
// that cannot be reached, with an event, and is FAILURE after a round in which no point could be reached.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/go_to_ports.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

/// What both share: the points, one leg after the other.
class PointsLeaf : public FlightLeaf {
 public:
  explicit PointsLeaf(const tree::NodeSetup& setup);

 protected:
  struct Leg {
    tree::Status status = tree::Status::kRunning;
    std::string problem;  ///< Why it is FAILURE: "point 2: no path".
  };
  /// Flies to the point: RUNNING, SUCCESS on arrival, FAILURE. A free place within `pass_within_m` is as good.
  Leg flyTo(FlightTick& tick, const tree::Point& point, common::FlightMode present, double pass_within_m = 0.0);
  /// The leg ends; the next one begins at the next tick.
  void endLeg();
  void onStart(tree::TickContext& context) override;
  void onResume(tree::TickContext& context) override;

  tree::Input<tree::Points> points_;
  std::size_t at_ = 0;  ///< The point that is being flown to.

 private:
  std::optional<common::GoToIntent> leg_;
  GoToPorts go_to_;
};

class FollowPath final : public PointsLeaf {
 public:
  explicit FollowPath(const tree::NodeSetup& setup)
      : PointsLeaf(setup), corner_m_(setup, "corner_m"), modes_(setup, "modes") {}
  static tree::NodeManifest manifest();

 private:
  tree::Status act(tree::TickContext& context) override;
  tree::Input<double> corner_m_;
  tree::Input<std::string> modes_;
};

/// The modes of a text "careful | fast", or what is wrong with it.
tl::expected<std::vector<common::FlightMode>, tree::Message> modesOf(const std::string& text);

class Patrol final : public PointsLeaf {
 public:
  explicit Patrol(const tree::NodeSetup& setup)
      : PointsLeaf(setup), rounds_(setup, "rounds"), pause_s_(setup, "pause_s") {}
  static tree::NodeManifest manifest();

 private:
  tree::Status act(tree::TickContext& context) override;
  void onStart(tree::TickContext& context) override;
  /// Whether the patrol is over.
  bool next(std::size_t points, std::int64_t rounds);

  tree::Input<std::int64_t> rounds_;
  tree::Input<tree::Duration> pause_s_;
  std::int64_t flown_rounds_ = 0;
  std::size_t left_out_ = 0;  ///< One after the other.
  std::optional<common::Time> arrived_;
};

}  // namespace swiftlet::behaviors
