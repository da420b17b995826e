// FindWindow: looks for an open window from where the vehicle stands (Tomic 2012, Fig. 4: the window detector
// determines the window's position more precisely). SUCCESS when one is confirmed that is wide enough; FAILURE when it
// was not detected from here, or was seen closed.
//
//   look towards the stored place, to both sides of it, then from places beside --confirmed, open--> SUCCESS
//        ^---------------- next view -----------------/        \--closed, or no view left--> FAILURE
//
// What one look cannot tell, a window from a mirror for example, looks from several places can.
#include "behaviors/leaves.hpp"

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <fmt/format.h>

#include "behaviors/leaf_traits.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/openings.hpp"
#include "behaviors/ports.hpp"
#include "behaviors/views_leaf.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

using common::RecognizedObject;
using tree::PortType;
using tree::Status;

/// Looks count from places that are 0.2 m apart: perception/recognition/object_tracker.cpp.
constexpr double kBeside_m = 0.35;
/// The picture is the same from there; nearer would take longer.
constexpr double kWindowViewTolerance_m = 0.1;
/// To both sides of a place that is off by half a metre and 10 deg, seen from 2 m; half of a camera's angle of view.
constexpr double kAside_rad = 29.0 * common::kRadPerDeg;
/// A full turn, by a little less than a camera's angle of view.
constexpr int kLooksAround = 8;

/// A place beside the one where it stands, along and across the direction to the window, and the turn from it.
struct WindowView {
  Eigen::Vector2d offset_m = Eigen::Vector2d::Zero();
  double turn_rad = 0.0;
};

class FindWindow final : public ViewsLeaf {
 public:
  explicit FindWindow(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  /// What the ports say.
  struct Wanted {
    std::optional<Eigen::Vector2d> near_map_m;  ///< nullopt: anywhere.
    double within_m, width_m, clearance_m;
  };
  void onStart(tree::TickContext& context) override;
  Status act(tree::TickContext& context) override;
  tl::expected<Wanted, std::string> wanted(const FlightTick& tick) const;
  Status found(tree::TickContext& context, const RecognizedObject& window);
  std::optional<common::GoToIntent> nextView(const FlightTick& tick, const Wanted& wanted,
                                             const RecognizedObject* candidate);
  static std::string whyNot(const FlightTick& tick, const Eigen::Vector2d& about_map_m, double within_m);

  tree::Input<tree::Point> near_;
  tree::Input<double> within_m_, width_m_, clearance_m_;
  tree::Output window_, place_;

  std::optional<common::Pose2> T_map_start_;  ///< Where it stands.
  std::size_t views_ = 0;                     ///< How many it has looked from.
};

/// The views in their order. `knows_direction`: there is a place to look at.
const std::vector<WindowView>& viewsWith(bool knows_direction) {
  static const std::vector<WindowView> kTowards = {
      {{0, 0}, 0},          {{0, 0}, kAside_rad}, {{0, 0}, -kAside_rad},   {{0, kBeside_m}, 0},
      {{0, -kBeside_m}, 0}, {{-kBeside_m, 0}, 0}, {{0, 2 * kBeside_m}, 0}, {{0, -2 * kBeside_m}, 0}};
  static const std::vector<WindowView> kAround = [] {
    std::vector<WindowView> views;
    for (const double aside_m : {0.0, kBeside_m, -kBeside_m})
      for (int i = 0; i < kLooksAround; ++i) views.push_back({{0, aside_m}, 2.0 * std::numbers::pi * i / kLooksAround});
    return views;
  }();
  return knows_direction ? kTowards : kAround;
}

tree::NodeManifest FindWindow::manifest() {
  return {.id = "FindWindow",
          .kind = tree::NodeKind::kAction,
          .ports = {{.name = "near",
                     .type = PortType::kPoint,
                     .description = "Where the window is stored, in the map frame, whose origin is the take-off pose, "
                                    "or in the given map; a z is ignored. Not given: it looks all around, and any "
                                    "window will do."},
                    {.name = "within_m",
                     .type = PortType::kDouble,
                     .default_value = "1.5",
                     .minimum = 0.1,
                     .maximum = 100.0,
                     .description = "How far the window may be from there."},
                    {.name = "width_m",
                     .type = PortType::kDouble,
                     .default_value = "0.75",
                     .minimum = 0.1,
                     .maximum = 10.0,
                     .description = "Least width: that of the hull, and 10 cm at each side."},
                    clearancePort(),
                    {.name = "window",
                     .type = PortType::kInt,
                     .direction = tree::Direction::kOutput,
                     .description = "Its number among the recognized objects."},
                    {.name = "place",
                     .type = PortType::kPoint,
                     .direction = tree::Direction::kOutput,
                     .description = "Its middle, in the given map in a flight with one."}},
          .description = "Looks for an open window from where the vehicle stands.",
          .details =
              "Towards the stored place first, then to both sides of it and from places beside, until a window is "
              "confirmed as open by looks from several places. Mirrors and closed windows do not count.",
          .ends = "SUCCESS when it is confirmed; FAILURE when none is detected from here, or it is closed",
          .traits = LeafTraits{.needs_camera = true}};
}

FindWindow::FindWindow(const tree::NodeSetup& setup)
    : ViewsLeaf(setup),
      near_(setup, "near"),
      within_m_(setup, "within_m"),
      width_m_(setup, "width_m"),
      clearance_m_(setup, "clearance_m"),
      window_(setup, "window"),
      place_(setup, "place") {}

void FindWindow::onStart(tree::TickContext& context) {
  ViewsLeaf::onStart(context);
  T_map_start_.reset();
  views_ = 0;
}

tl::expected<FindWindow::Wanted, std::string> FindWindow::wanted(const FlightTick& tick) const {
  const auto near = near_.get();
  const auto within_m = within_m_.get(), width_m = width_m_.get(), clearance_m = clearance_m_.get();
  if (near_.given() && !near) return tl::unexpected(near_.problem());
  if (!within_m) return tl::unexpected(within_m_.problem());
  if (!width_m) return tl::unexpected(width_m_.problem());
  if (!clearance_m) return tl::unexpected(clearance_m_.problem());
  const auto places = NamedPlaces::in(*tick.flight.world);
  if (!places) return tl::unexpected(places.error());
  if (tick.flight.world->objects == nullptr)
    return tl::unexpected(std::string("nothing is recognized: the profile has no recognizer of openings"));
  return Wanted{near ? std::optional(places->inMap_m(*near)) : std::nullopt, *within_m, *width_m, *clearance_m};
}

Status FindWindow::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  const auto wanted = this->wanted(tick);
  if (!wanted) return fail(context, wanted.error());
  const common::World& world = *tick.flight.world;
  if (!T_map_start_) T_map_start_ = world.vehicle->state.T_map_body_planar();
  const Eigen::Vector2d about_map_m = wanted->near_map_m.value_or(T_map_start_->position_m());
  // Without a stored place the windows that it can see from here count.
  constexpr double kSees_m = 6.0;
  const double within_m = wanted->near_map_m ? wanted->within_m : kSees_m;
  const RecognizedObject* candidate = nullptr;
  const RecognizedObject* closed = nullptr;
  for (const RecognizedObject* window : objectsNear(world, "window", about_map_m, within_m)) {
    if (isOpenFor(*window, wanted->width_m)) return found(context, *window);
    if (!window->confirmed && candidate == nullptr) candidate = window;
    if (window->passage == common::Passage::kClosed && closed == nullptr) closed = window;
  }
  if (closed != nullptr && candidate == nullptr && wanted->near_map_m)
    return fail(context, fmt::format("window {} is closed", closed->id));
  if (!lookOn(tick, [&] { return nextView(tick, *wanted, candidate); }))
    return fail(context, whyNot(tick, about_map_m, within_m));
  return Status::kRunning;
}

Status FindWindow::found(tree::TickContext& context, const RecognizedObject& window) {
  FlightTick& tick = flightTick(context);
  emitHold(tick);
  if (!holdReleased(tick)) return Status::kRunning;
  const Eigen::Vector3d& middle_map_m = window.T_map_object.position_m;
  window_.set(static_cast<std::int64_t>(window.id));
  place_.set(NamedPlaces::in(*tick.flight.world)->point(middle_map_m));
  tick.say(common::Severity::kInfo, fmt::format("window {} found", window.id),
           fmt::format("open, {:.2f} m wide, at {}, by {} looks", window.size_m.x(),
                       tick.flight.world->map->names().of(Eigen::Vector2d(middle_map_m.head<2>())), window.looks));
  return Status::kSuccess;
}

/// Views from other places face the candidate. Turns on the spot are left out then: they show nothing new of it.
std::optional<common::GoToIntent> FindWindow::nextView(const FlightTick& tick, const Wanted& wanted,
                                                       const RecognizedObject* candidate) {
  const Eigen::Vector2d here_map_m = T_map_start_->position_m();
  const std::optional<Eigen::Vector2d> at_map_m =
      candidate != nullptr ? std::optional<Eigen::Vector2d>(candidate->T_map_object.position_m.head<2>())
                           : wanted.near_map_m;
  const std::vector<WindowView>& views = viewsWith(wanted.near_map_m.has_value());
  while (views_ < views.size()) {
    const WindowView& view = views[views_++];
    if (candidate != nullptr && view.turn_rad != 0.0 && view.offset_m.isZero()) continue;
    const auto bearing = [&](const Eigen::Vector2d& from) {
      return at_map_m ? std::atan2((*at_map_m - from).y(), (*at_map_m - from).x()) : T_map_start_->yaw_rad;
    };
    common::GoToIntent intent;
    intent.goal_map_m = here_map_m + Eigen::Rotation2Dd(bearing(here_map_m)) * view.offset_m;
    const double turn_rad = candidate != nullptr ? 0.0 : view.turn_rad;
    intent.yaw_map_rad = common::wrapAngle(bearing(intent.goal_map_m) + turn_rad);
    intent.tolerance_m = kWindowViewTolerance_m;
    // Where it stands already it may be nearer to something than paths lead.
    intent.clearance_m = view.offset_m.isZero() ? 0.0 : wanted.clearance_m;
    intent.mode = tick.mode;
    const auto& map = tick.flight.goal_map;
    if (view.offset_m.isZero() || !map ||
        map->stateAt(intent.goal_map_m, wanted.clearance_m) == common::PlaceState::kFree)
      return intent;
  }
  return std::nullopt;
}

/// "no open window was detected from here: 1 mirror, 1 not confirmed".
std::string FindWindow::whyNot(const FlightTick& tick, const Eigen::Vector2d& about_map_m, double within_m) {
  const common::World& world = *tick.flight.world;
  std::size_t closed = 0, narrow = 0, unsure = 0;
  for (const RecognizedObject* window : objectsNear(world, "window", about_map_m, within_m))
    ++(!window->confirmed ? unsure : window->passage == common::Passage::kClosed ? closed : narrow);
  std::string text = "no open window was detected from here";
  const char* before = ": ";
  const auto add = [&](std::size_t count, const char* what) {
    if (count == 0) return;
    text += fmt::format("{}{} {}", before, count, what);
    before = ", ";
  };
  add(objectsNear(world, "mirror", about_map_m, within_m).size(), "mirror");
  add(closed, "closed");
  add(narrow, "too narrow");
  add(unsure, "not confirmed");
  return text;
}

}  // namespace

void addFindWindow(tree::Registry& registry) { registry.add<FindWindow>(); }

}  // namespace swiftlet::behaviors
