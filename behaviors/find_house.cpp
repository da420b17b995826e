// FindHouse: looks for a house of known shape, from above it if a height is given (Tomic 2012, section "Software
// Framework": the vehicle starts without sight of the house and finds it first). SUCCESS with its place when it is
// recognized from enough places, and the vehicle has stopped; FAILURE when nothing is left to look at.
//
//   climb --> towards the expected place | all around --> from the places around it --> explore --nothing left-->
//   FAILURE
//       \----------------------- recognized at any time: stop ----------------------/ --> SUCCESS
//
// A house that one look has recognized is looked at from other places, until it is confirmed.
#include "behaviors/leaves.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "behaviors/explore_ports.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/openings.hpp"
#include "behaviors/place_around.hpp"
#include "behaviors/ports.hpp"
#include "behaviors/views_leaf.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

using common::RecognizedObject;
using tree::PortType;
using tree::Status;

constexpr double kHouseViewTolerance_m = 0.25;  ///< The picture is the same from there; nearer would take longer.
/// A full turn, by a little less than half of a wide camera's angle of view: a house is to be seen whole.
constexpr int kHouseTurns = 8;
/// Places around the house, and sides of it that differ.
constexpr int kHousePlaces = 24;
constexpr double kOtherHouseSide_rad = 40.0 * common::kRadPerDeg;
/// Where it is only expected, the middle of the house is off by so much.
constexpr double kHouseNear_m = 3.0;

class FindHouse final : public ViewsLeaf {
 public:
  explicit FindHouse(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  struct Wanted {
    std::string name;
    std::optional<Eigen::Vector2d> expected_map_m;
    std::optional<double> height_m;
    double distance_m;
    common::ExploreIntent explore;
  };
  void onStart(tree::TickContext& context) override;
  Status act(tree::TickContext& context) override;
  tl::expected<Wanted, std::string> wanted(const FlightTick& tick) const;
  Status found(tree::TickContext& context, const RecognizedObject& house);
  std::optional<common::GoToIntent> nextView(const FlightTick& tick, const Wanted& wanted,
                                             const RecognizedObject* candidate);
  Status explore(tree::TickContext& context, const Wanted& wanted);

  tree::Input<std::string> name_;
  tree::Input<tree::Point> expected_;
  tree::Input<double> height_m_, distance_m_;
  ExplorePorts ports_;
  tree::Output house_, place_;

  std::optional<common::Pose2> T_map_start_;
  int turns_ = 0;                  ///< Views from where it began.
  std::vector<double> sides_rad_;  ///< Bearings from the house of the places from which it looked.
  bool explored_ = false;
};

tree::NodeManifest FindHouse::manifest() {
  tree::NodeManifest manifest{
      .id = "FindHouse",
      .kind = tree::NodeKind::kAction,
      .ports = {{.name = "house_name",
                 .type = PortType::kString,
                 .default_value = "house",
                 .description = "Name of the house, as the profile has it."},
                {.name = "expected",
                 .type = PortType::kPoint,
                 .description = "Where about its middle is, in the map frame, whose origin is the take-off pose, or in "
                                "the given map; a z is ignored. Not given: it looks all around."},
                {.name = "height_m",
                 .type = PortType::kDouble,
                 .description = "Height above the take-off floor from which it looks: above the roof. Not given: the "
                                "present height."},
                {.name = "distance_m",
                 .type = PortType::kDouble,
                 .default_value = "4.5",
                 .minimum = 1.0,
                 .maximum = 30.0,
                 .description = "How far from the middle of the house it looks at it: so that all of it is in the "
                                "picture."},
                {.name = "house",
                 .type = PortType::kInt,
                 .direction = tree::Direction::kOutput,
                 .description = "Its number among the recognized objects."},
                {.name = "place",
                 .type = PortType::kPoint,
                 .direction = tree::Direction::kOutput,
                 .description = "Middle of its floor, in the given map in a flight with one."}},
      .description = "Looks for a house of known shape.",
      .details =
          "It climbs, looks towards the expected place or all around, then from places around it, and at last "
          "explores, until the house is recognized from two places; it stops there. What one look has recognized is "
          "looked at from other places. `PlaceAtObject` tells where its door is.",
      .ends = "SUCCESS when it is recognized and the vehicle has stopped; FAILURE when nothing is left to look at",
      .traits = LeafTraits{.needs_camera = true}};
  for (tree::PortManifest& port : ExplorePorts::manifests()) manifest.ports.push_back(std::move(port));
  return manifest;
}

FindHouse::FindHouse(const tree::NodeSetup& setup)
    : ViewsLeaf(setup),
      name_(setup, "house_name"),
      expected_(setup, "expected"),
      height_m_(setup, "height_m"),
      distance_m_(setup, "distance_m"),
      ports_(setup),
      house_(setup, "house"),
      place_(setup, "place") {}

void FindHouse::onStart(tree::TickContext& context) {
  ViewsLeaf::onStart(context);
  T_map_start_.reset();
  turns_ = 0;
  sides_rad_.clear();
  explored_ = false;
}

tl::expected<FindHouse::Wanted, std::string> FindHouse::wanted(const FlightTick& tick) const {
  const auto name = name_.get();
  const auto expected = expected_.get();
  const auto height_m = height_m_.get(), distance_m = distance_m_.get();
  if (!name) return tl::unexpected(name_.problem());
  if (expected_.given() && !expected) return tl::unexpected(expected_.problem());
  if (height_m_.given() && !height_m) return tl::unexpected(height_m_.problem());
  if (!distance_m) return tl::unexpected(distance_m_.problem());
  const auto explore = ports_.intent(tick.mode, *tick.flight.world);
  if (!explore) return tl::unexpected(explore.error());
  const auto places = NamedPlaces::in(*tick.flight.world);
  if (!places) return tl::unexpected(places.error());
  if (tick.flight.world->objects == nullptr) return tl::unexpected(std::string("the profile recognizes nothing"));
  return Wanted{*name, expected ? std::optional(places->inMap_m(*expected)) : std::nullopt, height_m, *distance_m,
                *explore};
}

Status FindHouse::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  const auto wanted = this->wanted(tick);
  if (!wanted) return fail(context, wanted.error());
  const common::World& world = *tick.flight.world;
  if (!T_map_start_) T_map_start_ = world.vehicle->state.T_map_body_planar();
  const RecognizedObject* candidate = nullptr;
  for (const RecognizedObject* house :
       objectsNear(world, wanted->name, T_map_start_->position_m(), std::numeric_limits<double>::infinity())) {
    if (house->confirmed) return found(context, *house);
    if (candidate == nullptr) candidate = house;
  }
  if (lookOn(tick, [&] { return nextView(tick, *wanted, candidate); })) return Status::kRunning;
  return explore(context, *wanted);
}

Status FindHouse::found(tree::TickContext& context, const RecognizedObject& house) {
  FlightTick& tick = flightTick(context);
  emitHold(tick);
  if (!holdReleased(tick)) return Status::kRunning;
  const Eigen::Vector3d& middle_map_m = house.T_map_object.position_m;
  house_.set(static_cast<std::int64_t>(house.id));
  place_.set(NamedPlaces::in(*tick.flight.world)->point(middle_map_m));
  tick.say(common::Severity::kInfo, fmt::format("{} found", labelOf(house)),
           fmt::format("at {} +- {:.2f} m, its ridge at {:.0f} deg, by {} looks",
                       tick.flight.world->map->names().of(Eigen::Vector2d(middle_map_m.head<2>())), house.sigma_m(),
                       common::yawOf(house.T_map_object.rotation) / common::kRadPerDeg, house.looks));
  return Status::kSuccess;
}

/// First from where it began, then the nearest free place on another side.
std::optional<common::GoToIntent> FindHouse::nextView(const FlightTick& tick, const Wanted& wanted,
                                                      const RecognizedObject* candidate) {
  const std::optional<Eigen::Vector2d> middle_map_m =
      candidate != nullptr ? std::optional<Eigen::Vector2d>(candidate->T_map_object.position_m.head<2>())
                           : wanted.expected_map_m;
  common::GoToIntent view;
  view.height_m = wanted.height_m;
  view.tolerance_m = kHouseViewTolerance_m;
  view.mode = tick.mode;
  if (candidate == nullptr && turns_ < (wanted.expected_map_m ? 1 : kHouseTurns)) {
    const Eigen::Vector2d here_map_m = T_map_start_->position_m();
    const double towards_rad = middle_map_m
                                   ? std::atan2((*middle_map_m - here_map_m).y(), (*middle_map_m - here_map_m).x())
                                   : T_map_start_->yaw_rad;
    view.goal_map_m = here_map_m;
    view.yaw_map_rad = common::wrapAngle(towards_rad + 2.0 * std::numbers::pi * turns_++ / kHouseTurns);
    // Where it stands already it may be nearer to something than paths lead.
    view.clearance_m = 0.0;
    return view;
  }
  if (!middle_map_m) return std::nullopt;
  view.clearance_m = wanted.explore.clearance_m;
  const auto isOtherSide = [&](double side_rad) {
    return std::none_of(sides_rad_.begin(), sides_rad_.end(), [&](double before_rad) {
      return std::abs(common::wrapAngle(side_rad - before_rad)) < kOtherHouseSide_rad;
    });
  };
  for (const double share : {1.0, 0.8, 1.2}) {
    const PlacesAround around{*middle_map_m, share * wanted.distance_m, kHousePlaces, kHouseNear_m};
    auto place = nearestPlaceAround(tick, around, view, isOtherSide);
    if (!place) continue;
    const Eigen::Vector2d from = place->goal_map_m - *middle_map_m;
    sides_rad_.push_back(std::atan2(from.y(), from.x()));
    return place;
  }
  return std::nullopt;
}

Status FindHouse::explore(tree::TickContext& context, const Wanted& wanted) {
  FlightTick& tick = flightTick(context);
  if (explored_) return fail(context, fmt::format("no `{}` was recognized", wanted.name));
  emitIntent(tick, wanted.explore);
  if (intentState(tick) == common::IntentState::kFailed)
    return fail(context, fmt::format("no `{}` was recognized: {}", wanted.name, tick.flight.status.reason));
  explored_ = intentState(tick) == common::IntentState::kSucceeded;
  return Status::kRunning;
}

}  // namespace

void addFindHouse(tree::Registry& registry) { registry.add<FindHouse>(); }

}  // namespace swiftlet::behaviors
