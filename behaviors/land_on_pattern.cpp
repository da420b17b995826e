// LandOnPattern: searches for a landing pattern with a camera that looks down, flies over it and lands on it (Tomic
// 2012, section "Mission"). What is told apart by its name is not landed on. SUCCESS on the pattern; FAILURE in the air
// when it is not seen, unless the vehicle is to land anyway.
//
//   survey around where it began --confirmed--> stop --> fly over it --> land, on what is below --> SUCCESS
//       \--- all of it seen ---> FAILURE, or land where it is
#include "behaviors/leaves.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/openings.hpp"
#include "behaviors/ports.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

using common::IntentState;
using common::RecognizedObject;
using tree::PortType;
using tree::Status;

/// Over the pattern: near enough that it fills the middle of the picture and the descent begins at once.
constexpr double kOverTolerance_m = 0.15;
/// Where the hull fits beside the middle, but not over it, the vehicle may begin from there: a landing flies to the
/// middle of a pattern that is that near (autonomy/maneuvers/pattern_descent.hpp).
constexpr double kBesideMiddle_m = 0.4;
/// A vehicle that stands farther off does not stand on the pattern: half of the smallest one that carries a hull.
constexpr double kLeastHalf_m = 0.15;

class LandOnPattern final : public FlightLeaf {
 public:
  explicit LandOnPattern(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  enum class Phase { kSearches, kStops, kFliesOver, kLandsOn, kLandsElsewhere };
  struct Ports {
    std::string pattern;
    double radius_m, clearance_m;
    std::optional<double> height_m;
    bool elsewhere;
    common::FlightMode mode;
  };

  void onStart(tree::TickContext& context) override;
  Status act(tree::TickContext& context) override;
  std::string problemOfPorts() const;
  Status search(tree::TickContext& context, const Ports& ports);
  Status notSeen(tree::TickContext& context, const Ports& ports, const std::string& why);
  void flyOver(FlightTick& tick, const RecognizedObject& object, const Ports& ports);
  Status landOn(tree::TickContext& context, const RecognizedObject& object, const Ports& ports);
  void enter(Phase phase);

  tree::Input<std::string> pattern_;
  tree::Input<double> radius_m_, height_m_, clearance_m_;
  tree::Input<bool> elsewhere_;
  tree::Input<std::string> mode_;
  tree::Output place_;

  Phase phase_ = Phase::kSearches;
  int object_id_ = 0;                          ///< 0 while none is chosen.
  std::optional<Eigen::Vector2d> from_map_m_;  ///< Where it began: the middle of the search.
};

tree::NodeManifest LandOnPattern::manifest() {
  return {
      .id = "LandOnPattern",
      .kind = tree::NodeKind::kAction,
      .ports = {{.name = "pattern",
                 .type = PortType::kString,
                 .required = true,
                 .description = "Name of the pattern, as the profile has it."},
                {.name = "radius_m",
                 .type = PortType::kDouble,
                 .default_value = "2.0",
                 .minimum = 0.0,
                 .maximum = 20.0,
                 .description = "How far around the place where it begins it searches in each direction."},
                {.name = "height_m",
                 .type = PortType::kDouble,
                 .description = "Height above the take-off floor at which it searches; the pattern should cover 40 "
                                "pixels or more from there. Not given: the present height."},
                {.name = "elsewhere",
                 .type = PortType::kBool,
                 .default_value = "false",
                 .description = "Land where it is if the pattern is not found."},
                clearancePort(),
                modePort(),
                {.name = "place",
                 .type = PortType::kPoint,
                 .direction = tree::Direction::kOutput,
                 .description = "Middle of the pattern, in the given map in a flight with one."}},
      .description = "Searches for a landing pattern below and lands on it.",
      .details =
          "It flies in lanes until the camera, which must look down, has confirmed the pattern of that name; then over "
          "it, and down while its place is tracked, to half a metre; from there it lands. Patterns of other names "
          "are not landed on. An event says how far off the middle it stands.",
      .ends =
          "SUCCESS when it stands on the pattern; FAILURE in the air when the pattern is not found or no path leads "
          "over it, unless it may land `elsewhere`, and on the ground when it was blown off",
      .traits = LeafTraits{.vehicle = VehicleUse::kLands}};
}

LandOnPattern::LandOnPattern(const tree::NodeSetup& setup)
    : FlightLeaf(setup),
      pattern_(setup, "pattern"),
      radius_m_(setup, "radius_m"),
      height_m_(setup, "height_m"),
      clearance_m_(setup, "clearance_m"),
      elsewhere_(setup, "elsewhere"),
      mode_(setup, "mode"),
      place_(setup, "place") {}

void LandOnPattern::onStart(tree::TickContext& context) {
  FlightLeaf::onStart(context);
  phase_ = Phase::kSearches;
  object_id_ = 0;
  from_map_m_.reset();
}

void LandOnPattern::enter(Phase phase) {
  phase_ = phase;
  renewIntent();
}

std::string LandOnPattern::problemOfPorts() const {
  if (!pattern_.get()) return pattern_.problem();
  if (!radius_m_.get()) return radius_m_.problem();
  if (height_m_.given() && !height_m_.get()) return height_m_.problem();
  if (!clearance_m_.get()) return clearance_m_.problem();
  if (!elsewhere_.get()) return elsewhere_.problem();
  return modeOr(mode_, common::FlightMode::kFast) ? std::string() : mode_.problem();
}

Status LandOnPattern::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  if (const std::string problem = problemOfPorts(); !problem.empty()) return fail(context, problem);
  const Ports ports{*pattern_.get(), *radius_m_.get(),  *clearance_m_.get(),
                    height_m_.get(), *elsewhere_.get(), *modeOr(mode_, tick.mode)};
  if (phase_ == Phase::kLandsElsewhere) {
    emitIntent(tick, common::LandIntent{});
    if (intentState(tick) == IntentState::kFailed) return fail(context, tick.flight.status.reason);
    return intentState(tick) == IntentState::kSucceeded ? Status::kSuccess : Status::kRunning;
  }
  if (phase_ == Phase::kSearches) return search(context, ports);
  const RecognizedObject* object = objectWithId(*tick.flight.world, object_id_);
  if (object == nullptr) return notSeen(context, ports, "`" + ports.pattern + "` is not known any more");
  return landOn(context, *object, ports);
}

Status LandOnPattern::search(tree::TickContext& context, const Ports& ports) {
  FlightTick& tick = flightTick(context);
  const common::World& world = *tick.flight.world;
  const Eigen::Vector2d here_map_m = world.vehicle->state.T_map_body_planar().position_m();
  if (!world.objects) return notSeen(context, ports, "the profile recognizes nothing");
  for (const RecognizedObject* object :
       objectsNear(world, ports.pattern, here_map_m, std::numeric_limits<double>::infinity())) {
    if (!object->confirmed) continue;
    object_id_ = object->id;
    enter(Phase::kStops);
    return landOn(context, *object, ports);
  }
  if (!from_map_m_) from_map_m_ = here_map_m;
  common::SurveyIntent survey;
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, -1), Eigen::Vector2d(1, 1), Eigen::Vector2d(-1, 1)})
    survey.area.corners_map_m.push_back(*from_map_m_ + std::max(ports.radius_m, 0.1) * corner);
  survey.height_m = ports.height_m;
  survey.clearance_m = ports.clearance_m;
  survey.mode = ports.mode;
  emitIntent(tick, survey);
  if (intentState(tick) == IntentState::kRunning) return Status::kRunning;
  return notSeen(context, ports,
                 intentState(tick) == IntentState::kSucceeded
                     ? fmt::format("no `{}` was seen within {:.1f} m", ports.pattern, ports.radius_m)
                     : fmt::format("no `{}` was seen: {}", ports.pattern, tick.flight.status.reason));
}

Status LandOnPattern::notSeen(tree::TickContext& context, const Ports& ports, const std::string& why) {
  if (!ports.elsewhere) return fail(context, why);
  FlightTick& tick = flightTick(context);
  tick.say(common::Severity::kWarning, "lands elsewhere than on `" + ports.pattern + "`", why);
  enter(Phase::kLandsElsewhere);
  emitIntent(tick, common::LandIntent{});
  return Status::kRunning;
}

/// By a planned path, as far as one leads there.
void LandOnPattern::flyOver(FlightTick& tick, const RecognizedObject& object, const Ports& ports) {
  common::GoToIntent over;
  over.goal_map_m = object.T_map_object.position_m.head<2>();
  over.height_m = ports.height_m;
  over.tolerance_m = kOverTolerance_m;
  over.shift_m = kBesideMiddle_m;
  over.clearance_m = ports.clearance_m;
  over.mode = ports.mode;
  emitIntent(tick, over);
}

Status LandOnPattern::landOn(tree::TickContext& context, const RecognizedObject& object, const Ports& ports) {
  FlightTick& tick = flightTick(context);
  const Eigen::Vector3d& middle_map_m = object.T_map_object.position_m;
  if (phase_ == Phase::kStops) {
    emitHold(tick);
    if (!holdReleased(tick)) return Status::kRunning;
    tick.say(common::Severity::kInfo, "found `" + ports.pattern + "`",
             fmt::format("at {} +- {:.2f} m", tick.flight.world->map->names().of(middle_map_m), object.sigma_m()));
    enter(Phase::kFliesOver);
  }
  if (phase_ == Phase::kFliesOver) {
    flyOver(tick, object, ports);
    if (intentState(tick) == IntentState::kFailed)
      return notSeen(context, ports, "no path over `" + ports.pattern + "`: " + tick.flight.status.reason);
    if (intentState(tick) == IntentState::kRunning) return Status::kRunning;
    enter(Phase::kLandsOn);
  }
  emitIntent(tick, common::LandIntent{});
  if (intentState(tick) == IntentState::kRunning) return Status::kRunning;
  if (intentState(tick) == IntentState::kFailed) return fail(context, tick.flight.status.reason);
  const double off_m =
      (middle_map_m.head<2>() - tick.flight.world->vehicle->state.T_map_body_planar().position_m()).norm();
  if (off_m > std::max(kLeastHalf_m, 0.5 * object.size_m.minCoeff()))
    return fail(context, fmt::format("it stands {:.2f} m off the middle of `{}`", off_m, ports.pattern));
  if (const auto places = NamedPlaces::in(*tick.flight.world)) place_.set(places->point(middle_map_m));
  return Status::kSuccess;
}

}  // namespace

void addLandOnPattern(tree::Registry& registry) { registry.add<LandOnPattern>(); }

}  // namespace swiftlet::behaviors
