// LocateTarget: flies to where the camera sees a target well, and looks at it from several sides until its place is
// known to `sigma_m`. SUCCESS then, with the camera on it; each success is about a new target.
// FAILURE when no other is known, or when looking from all sides was not enough.
//
//   choose the nearest --> fly to a free place to look from, facing it --> look --known well--> SUCCESS
//                               ^------------ from another side -------------/  \--no side left--> FAILURE
#include "behaviors/leaves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/place_around.hpp"
#include "behaviors/target_ports.hpp"
#include "common/geometry.hpp"
#include "common/world.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/targets_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

using tree::PortType;
using tree::Status;

class LocateTarget final : public FlightLeaf {
 public:
  explicit LocateTarget(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  struct Ports {
    std::string name;
    double sigma_m, distance_m, clearance_m;
    common::FlightMode mode;
  };
  void onStart(tree::TickContext& context) override;
  void onResume(tree::TickContext& context) override;
  tree::Status act(tree::TickContext& context) override;
  tree::Status look(FlightTick& tick, const common::Target& target, const Ports& ports);
  /// The target's place is known: writes it.
  tree::Status located(tree::TickContext& context, const common::Target& target);
  std::string problemOfPorts() const;
  /// Where to look from next; nullopt: no side is left.
  std::optional<common::GoToIntent> nextView(const FlightTick& tick, const common::Target& target,
                                             const Ports& ports) const;

  tree::Input<std::string> name_;
  tree::Input<double> sigma_m_, distance_m_, clearance_m_;
  tree::Input<std::string> mode_;
  tree::Output place_, file_;

  int target_ = 0;                 ///< Id of the target; 0 while none is chosen.
  std::vector<double> sides_rad_;  ///< Bearings from the target of the places that were flown to.
  std::optional<common::GoToIntent> view_;
  std::optional<common::Time> looks_since_;  ///< When it was there.
};

/// At a place: at least until the frames taken there have counted, and at most this long.
constexpr double kLeastLook_s = 0.6, kMostLook_s = 2.0;
/// Sides that differ by less are one side.
constexpr double kOtherSide_rad = 55.0 * common::kRadPerDeg;
constexpr int kSides = 24;  ///< Every 15 degrees, a fraction of kOtherSide_rad.
/// The picture of a camera that looks ahead or slightly down ends at some 25 degrees below and 10 above.
constexpr double kTanBelow = 0.47, kTanAbove = 0.18;
/// An obstacle at the target's own place does not hide it from any side.
constexpr double kTargetNear_m = 0.5;
constexpr double kViewTolerance_m = 0.15;  ///< The picture is the same from there; nearer would take longer.

const common::Target* withId(const common::TargetsLayer& layer, int id) {
  const auto found = std::find_if(layer.targets.begin(), layer.targets.end(),
                                  [id](const common::Target& target) { return target.id == id; });
  return found == layer.targets.end() ? nullptr : &*found;
}

/// "red_1": what can name a file.
std::string fileOf(const common::Target& target) {
  std::string name = labelOf(target).substr(0, 40);
  std::replace_if(
      name.begin(), name.end(),
      [](char c) {
        return fileNameProblem({&c, 1}).has_value();
      },
      '_');
  return name;
}

/// The nearest of that name that is not in the list; null without one.
const common::Target* nearestOther(const FlightTick& tick, const std::string& name) {
  const Eigen::Vector2d here_map_m = tick.flight.world->vehicle->state.T_map_body_planar().position_m();
  const common::Target* nearest = nullptr;
  for (const common::Target& target : tick.flight.world->targets->targets) {
    const auto& located = tick.located_targets;
    if (!hasName(target, name) || std::find(located.begin(), located.end(), target.id) != located.end()) continue;
    const auto away_m = [&](const common::Target& t) { return (t.position_map_m.head<2>() - here_map_m).norm(); };
    if (nearest == nullptr || away_m(target) < away_m(*nearest)) nearest = &target;
  }
  return nearest;
}

tree::NodeManifest LocateTarget::manifest() {
  return {
      .id = "LocateTarget",
      .kind = tree::NodeKind::kAction,
      .ports = {targetNamePort(),
                {.name = "sigma_m",
                 .type = PortType::kDouble,
                 .default_value = "0.08",
                 .minimum = 0.01,
                 .maximum = 5.0,
                 .description = "Greatest standard deviation of the target's place."},
                {.name = "distance_m",
                 .type = PortType::kDouble,
                 .default_value = "1.8",
                 .minimum = 0.5,
                 .maximum = 10.0,
                 .description = "Horizontal distance of the vehicle's centre from the target; more where the target is "
                                "so far below or above that it would leave the picture."},
                clearancePort(),
                modePort(),
                {.name = "place",
                 .type = PortType::kPoint,
                 .direction = tree::Direction::kOutput,
                 .description = "Position of the target, in the given map in a flight with one."},
                {.name = "file",
                 .type = PortType::kString,
                 .direction = tree::Direction::kOutput,
                 .description = "Name and number of the target, as a part of a file's name."}},
      .description = "Looks at a target from several sides until its place is known well.",
      .details =
          "It flies to where the camera sees the nearest target of that name well, found or candidate, and looks until "
          "the place is known to `sigma_m`; writes `place`, and `file` as a part of a file's name (`red_1`). Each "
          "LocateTarget in a mission takes a target that no earlier one has ended with.",
      .ends = "SUCCESS with the camera on it; FAILURE when no other target is known, or when all sides were not enough",
      .traits = LeafTraits{.needs_camera = true, .about_targets = true}};
}

LocateTarget::LocateTarget(const tree::NodeSetup& setup)
    : FlightLeaf(setup),
      name_(setup, "target"),
      sigma_m_(setup, "sigma_m"),
      distance_m_(setup, "distance_m"),
      clearance_m_(setup, "clearance_m"),
      mode_(setup, "mode"),
      place_(setup, "place"),
      file_(setup, "file") {}

void LocateTarget::onStart(tree::TickContext& context) {
  FlightLeaf::onStart(context);
  target_ = 0;
  sides_rad_.clear();
  view_.reset();
  looks_since_.reset();
}

/// It looks from the same place again.
void LocateTarget::onResume(tree::TickContext& context) {
  FlightLeaf::onResume(context);
  looks_since_.reset();
}

std::string LocateTarget::problemOfPorts() const {
  if (!name_.get()) return name_.problem();
  if (!sigma_m_.get()) return sigma_m_.problem();
  if (!distance_m_.get()) return distance_m_.problem();
  if (!clearance_m_.get()) return clearance_m_.problem();
  return modeOr(mode_, common::FlightMode::kFast) ? std::string() : mode_.problem();
}

Status LocateTarget::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  if (const std::string problem = problemOfPorts(); !problem.empty()) return fail(context, problem);
  const Ports ports{*name_.get(), *sigma_m_.get(), *distance_m_.get(), *clearance_m_.get(), *modeOr(mode_, tick.mode)};
  const common::Target* target = withId(*tick.flight.world->targets, target_);
  if (target == nullptr) {  // No target is chosen, or the candidate was dropped after free-space violations.
    onStart(context);
    target = nearestOther(tick, ports.name);
    if (target == nullptr)
      return fail(context, fmt::format("no {}target is known{}", ports.name.empty() ? "" : "`" + ports.name + "` ",
                                       tick.located_targets.empty() ? "" : " that was not located"));
    target_ = target->id;
  }
  const Status status = look(tick, *target, ports);
  if (status == Status::kSuccess) return located(context, *target);
  if (status == Status::kRunning) return status;
  tick.located_targets.push_back(target_);  // The next try is about another one.
  return fail(context, sides_rad_.empty() ? fmt::format("no place to see {} from is free", labelOf(*target))
                                          : fmt::format("{} is known to {:.2f} m after looking from {} sides",
                                                        labelOf(*target), target->sigma_m(), sides_rad_.size()));
}

Status LocateTarget::located(tree::TickContext& context, const common::Target& target) {
  FlightTick& tick = flightTick(context);
  const auto places = NamedPlaces::in(*tick.flight.world);
  if (!places) return fail(context, places.error());
  tick.located_targets.push_back(target.id);
  place_.set(places->point(target.position_map_m));
  file_.set(fileOf(target));
  return Status::kSuccess;
}

Status LocateTarget::look(FlightTick& tick, const common::Target& target, const Ports& ports) {
  if (looks_since_) {
    emitHold(tick);
    const double looked_s = (tick.flight.now - *looks_since_).seconds();
    const bool known = target.state == common::TargetState::kFound && target.sigma_m() <= ports.sigma_m;
    if (known && looked_s >= kLeastLook_s) return Status::kSuccess;
    if (looked_s < kMostLook_s) return Status::kRunning;
    view_.reset();
    looks_since_.reset();
  }
  if (!view_) {
    view_ = nextView(tick, target, ports);
    if (!view_) return Status::kFailure;
    const Eigen::Vector2d from = view_->goal_map_m - target.position_map_m.head<2>();
    sides_rad_.push_back(std::atan2(from.y(), from.x()));
    renewIntent();
  }
  emitIntent(tick, *view_);
  if (intentState(tick) == common::IntentState::kSucceeded) looks_since_ = tick.flight.now;
  if (intentState(tick) == common::IntentState::kFailed) view_.reset();
  return Status::kRunning;
}

/// Among the free places on other sides, the one that is nearest to the vehicle.
std::optional<common::GoToIntent> LocateTarget::nextView(const FlightTick& tick, const common::Target& target,
                                                         const Ports& ports) const {
  const double below_m = tick.flight.world->vehicle->state.T_map_body().position_m.z() - target.position_map_m.z();
  const double least_m = std::max({ports.distance_m, below_m / kTanBelow, -below_m / kTanAbove});
  common::GoToIntent view;
  view.tolerance_m = kViewTolerance_m;
  view.clearance_m = ports.clearance_m;
  view.mode = ports.mode;
  const auto isOtherSide = [&](double side_rad) {
    return std::none_of(sides_rad_.begin(), sides_rad_.end(), [&](double before_rad) {
      return std::abs(common::wrapAngle(side_rad - before_rad)) < kOtherSide_rad;
    });
  };
  for (const double share : {1.0, 1.25, 0.85}) {
    const PlacesAround around{target.position_map_m.head<2>(), share * least_m, kSides, kTargetNear_m};
    if (const auto nearest = nearestPlaceAround(tick, around, view, isOtherSide)) return nearest;
  }
  return std::nullopt;
}

}  // namespace

void addLocateTarget(tree::Registry& registry) { registry.add<LocateTarget>(); }

}  // namespace swiftlet::behaviors
