// FindPositionIndoor: flies to another place in the known free space from which the wall at a stored place can be seen
// (Tomic 2012, Fig. 4, the fall-back where the window cannot be detected). Of all such places it takes the one that is
// farthest from those where it was before. SUCCESS there, facing the stored place; FAILURE when none is left.
#include "behaviors/leaves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/ports.hpp"
#include "common/line_of_sight.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

using tree::Status;

constexpr double kPositionTolerance_m = 0.15;  ///< The picture is the same from there; nearer would take longer.
/// Distances from the stored place: a window of 1 m fills the picture from 1.3 m on, and depths end at 5 m.
constexpr std::array kFrom_m = {1.6, 2.2, 2.8, 3.4};
constexpr int kBearings = 24;  ///< Every 15 degrees.
/// A place that is nearer to one where it was shows nothing else.
constexpr double kOtherPlace_m = 0.6;
/// What stands at the stored place, the wall, hides nothing; that place is off by so much.
constexpr double kStoredOff_m = 0.6;
/// On the side of the wall where it began: cos 65 deg to the direction from which it first looked. More aslant a window
/// is hardly seen.
constexpr double kLeastCosine = 0.42;

class FindPositionIndoor final : public FlightLeaf {
 public:
  explicit FindPositionIndoor(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  void onStart(tree::TickContext& context) override;
  Status act(tree::TickContext& context) override;
  std::optional<common::GoToIntent> choose(const FlightTick& tick, const Eigen::Vector2d& near_map_m,
                                           double clearance_m) const;

  tree::Input<tree::Point> near_;
  tree::Input<double> clearance_m_;

  /// Where it was, also in runs before: the first one is where it began.
  std::vector<Eigen::Vector2d> tried_map_m_;
  std::optional<common::GoToIntent> position_;
};

tree::NodeManifest FindPositionIndoor::manifest() {
  tree::PortManifest near = placePort("near");
  near.description = "Where the window is stored. " + near.description;
  return {.id = "FindPositionIndoor",
          .kind = tree::NodeKind::kAction,
          .ports = {std::move(near), clearancePort()},
          .description = "Flies to another place from which the wall at a stored place can be seen.",
          .details =
              "In known free space, on the same side of the wall, 1.6 to 3.4 m from the stored place, and as far as "
              "possible from all places where it looked before, also in earlier runs of the same node.",
          .ends = "SUCCESS there, facing the stored place; FAILURE when no such place is left"};
}

FindPositionIndoor::FindPositionIndoor(const tree::NodeSetup& setup)
    : FlightLeaf(setup), near_(setup, "near"), clearance_m_(setup, "clearance_m") {}

void FindPositionIndoor::onStart(tree::TickContext& context) {
  FlightLeaf::onStart(context);
  position_.reset();
}

Status FindPositionIndoor::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  const auto near = near_.get();
  const auto clearance_m = clearance_m_.get();
  if (!near) return fail(context, near_.problem());
  if (!clearance_m) return fail(context, clearance_m_.problem());
  const auto places = NamedPlaces::in(*tick.flight.world);
  if (!places) return fail(context, places.error());
  if (!position_) {
    const Eigen::Vector2d here_map_m = tick.flight.world->vehicle->state.T_map_body_planar().position_m();
    tried_map_m_.push_back(here_map_m);
    position_ = choose(tick, places->inMap_m(*near), *clearance_m);
    if (!position_) return fail(context, "no other place is known from which it can be seen");
    renewIntent();
  }
  emitIntent(tick, *position_);
  switch (intentState(tick)) {
    case common::IntentState::kSucceeded:
      return Status::kSuccess;
    case common::IntentState::kFailed:
      tried_map_m_.push_back(position_->goal_map_m);
      position_.reset();
      break;
    case common::IntentState::kRunning:
      break;
  }
  return Status::kRunning;
}

std::optional<common::GoToIntent> FindPositionIndoor::choose(const FlightTick& tick, const Eigen::Vector2d& near_map_m,
                                                             double clearance_m) const {
  const common::OccupancyGrid& grid = *tick.flight.world->map->grid;
  const auto& map = tick.flight.goal_map;
  const Eigen::Vector2d first = tried_map_m_.front() - near_map_m, here_map_m = tried_map_m_.back();
  const auto untried_m = [&](const Eigen::Vector2d& place) {
    double least_m = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector2d& tried : tried_map_m_) least_m = std::min(least_m, (place - tried).norm());
    return least_m;
  };
  std::optional<common::GoToIntent> best;
  double best_m = kOtherPlace_m;
  for (const double from_m : kFrom_m)
    for (int i = 0; i < kBearings; ++i) {
      const double bearing_rad = 2.0 * std::numbers::pi * i / kBearings;
      const Eigen::Vector2d towards(std::cos(bearing_rad), std::sin(bearing_rad));
      const Eigen::Vector2d place = near_map_m + from_m * towards;
      if (towards.dot(first) < kLeastCosine * first.norm() || untried_m(place) <= best_m) continue;
      if (map && map->stateAt(place, clearance_m) != common::PlaceState::kFree) continue;
      if (!common::isInSight(grid, place, near_map_m, kStoredOff_m)) continue;
      // Seen from here: what is behind the window is in sight of it, too.
      if (!common::isInSight(grid, here_map_m, place, 0.0)) continue;
      best_m = untried_m(place);
      best.emplace();
      best->goal_map_m = place;
      best->yaw_map_rad = common::wrapAngle(bearing_rad + std::numbers::pi);
      best->tolerance_m = kPositionTolerance_m;
      best->clearance_m = clearance_m;
      best->mode = tick.mode;
    }
  return best;
}

}  // namespace

void addFindPositionIndoor(tree::Registry& registry) { registry.add<FindPositionIndoor>(); }

}  // namespace swiftlet::behaviors
