#include "behaviors/follow_path.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>

#include <fmt/format.h>

#include "behaviors/leaf_traits.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/ports.hpp"
#include "common/world.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {

using tree::PortType;
using tree::Status;

namespace {

tree::PortManifest pointsPort() {
  return {.name = "points",
          .type = PortType::kPoints,
          .required = true,
          .description =
              "In the map frame, whose origin is the take-off pose, or in the given map; z above the take-off floor, "
              "or none: the present height."};
}

/// Those of every PointsLeaf, and its own.
std::vector<tree::PortManifest> pointsPorts(std::initializer_list<tree::PortManifest> own) {
  std::vector<tree::PortManifest> ports{pointsPort(), tolerancePort(), shiftPort(), clearancePort(), modePort()};
  ports.insert(ports.end(), own);
  return ports;
}

/// Infinite while it is not known where the point lies.
double distanceTo_m(const FlightTick& tick, const tree::Point& point) {
  const Eigen::Vector2d here_map_m = tick.flight.world->vehicle->state.T_map_body_planar().position_m();
  const auto places = NamedPlaces::in(*tick.flight.world);
  return places ? (here_map_m - places->inMap_m(point)).norm() : std::numeric_limits<double>::infinity();
}

}  // namespace

PointsLeaf::PointsLeaf(const tree::NodeSetup& setup) : FlightLeaf(setup), points_(setup, "points"), go_to_(setup) {}

void PointsLeaf::onStart(tree::TickContext& context) {
  FlightLeaf::onStart(context);
  at_ = 0;
  leg_.reset();
}

void PointsLeaf::onResume(tree::TickContext& context) {
  FlightLeaf::onResume(context);
  leg_.reset();
}

void PointsLeaf::endLeg() {
  leg_.reset();
  renewIntent();
}

PointsLeaf::Leg PointsLeaf::flyTo(FlightTick& tick, const tree::Point& point, common::FlightMode present,
                                  double pass_within_m) {
  const auto failed = [this](const std::string& problem) {
    return Leg{Status::kFailure, fmt::format("point {}: {}", at_ + 1, problem)};
  };
  if (leg_ && hasMoved(*leg_, *tick.flight.world)) endLeg();
  if (!leg_) {
    const auto leg = go_to_.intentTo(point, tick, present);
    if (!leg) return failed(leg.error());
    const auto verdict = common::judgeGoal(common::goalOf(*leg), tick.flight.goal_limits, nullptr);
    if (!verdict) return failed(verdict.error().text);
    leg_ = *leg;
    if (pass_within_m > 0.0) {
      leg_->shift_m = std::max(leg_->shift_m, pass_within_m);
      leg_->shift_after_s = 0.0;
    }
  }
  emitIntent(tick, *leg_);
  switch (intentState(tick)) {
    case common::IntentState::kRunning:
      return {};
    case common::IntentState::kSucceeded:
      return {Status::kSuccess, {}};
    case common::IntentState::kFailed:
      return failed(tick.flight.status.reason);
  }
  return {};
}

tree::NodeManifest FollowPath::manifest() {
  return {
      .id = "FollowPath",
      .kind = tree::NodeKind::kAction,
      .ports = pointsPorts(
          {{.name = "corner_m",
            .type = PortType::kDouble,
            .default_value = "0.30",
            .minimum = 0.01,
            .maximum = 5.0,
            .description = "A point before the last one is passed when nearer than this."},
           {.name = "modes",
            .type = PortType::kString,
            .description = "The modes of the legs to the points, `careful | fast`; the last one holds for the "
                           "rest. Not given: `mode`."}}),
      .description = "Flies through points to the last one.",
      .details =
          "The points before the last are passed without a stop; `modes=\"careful | fast\"` gives each leg its mode.",
      .ends = "SUCCESS at the last point, or beside it as for `MoveToGoal`"};
}

tl::expected<std::vector<common::FlightMode>, tree::Message> modesOf(const std::string& text) {
  std::vector<common::FlightMode> modes;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find('|', from), text.size());
    std::string word = text.substr(from, to - from);
    word.erase(0, word.find_first_not_of(' '));
    word.erase(word.find_last_not_of(' ') + 1);
    const auto known = std::find_if(common::kFlightModes.begin(), common::kFlightModes.end(),
                                    [&](common::FlightMode mode) { return word == toString(mode); });
    if (known == common::kFlightModes.end())
      return tl::unexpected(tree::Message(
          "mission.unknown-mode", "`{}` is not a flight mode, expected fast, careful, accurate or brisk", word));
    modes.push_back(*known);
    from = to + 1;
  }
  return modes;
}

Status FollowPath::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  const auto path = points_.get();
  const auto corner_m = corner_m_.get();
  if (!path) return fail(context, points_.problem());
  if (!corner_m) return fail(context, corner_m_.problem());
  std::vector<common::FlightMode> modes{tick.mode};
  if (modes_.given()) {
    const auto text = modes_.get();
    if (!text) return fail(context, modes_.problem());
    const auto given = modesOf(*text);
    if (!given) return fail(context, given.error().text());
    modes = *given;
  }
  const auto modeOfLeg = [&] { return modes[std::min(at_, modes.size() - 1)]; };
  const std::size_t last = path->points.size() - 1;
  while (at_ < last && distanceTo_m(tick, path->points[at_]) < *corner_m) {
    ++at_;
    endLeg();
  }
  at_ = std::min(at_, last);
  const auto flyLeg = [&] { return flyTo(tick, path->points[at_], modeOfLeg(), at_ < last ? *corner_m : 0.0); };
  Leg leg = flyLeg();
  if (leg.status == Status::kSuccess && at_ < last) {
    ++at_;
    endLeg();
    leg = flyLeg();
  }
  return leg.status == Status::kFailure ? fail(context, leg.problem) : leg.status;
}

tree::NodeManifest Patrol::manifest() {
  return {.id = "Patrol",
          .kind = tree::NodeKind::kAction,
          .ports = pointsPorts(
              {{.name = "rounds",
                .type = PortType::kInt,
                .default_value = "0",
                .minimum = 0.0,
                .maximum = 9999.0,
                .description = "How often all points are visited; 0: until something above the node ends it."},
               {.name = "pause_s",
                .type = PortType::kDuration,
                .default_value = "2",
                .minimum = 0.0,
                .maximum = 3600.0,
                .description = "Time at each point."}}),
          .description = "Visits points in turn, again and again.",
          .details = "It waits at each; a point that cannot be reached is left out, with an event.",
          .ends = "SUCCESS after `rounds` rounds, never with `rounds=\"0\"`; FAILURE after a round without any point",
          .traits = LeafTraits{.never_succeeds_at_0 = "rounds"}};
}

void Patrol::onStart(tree::TickContext& context) {
  PointsLeaf::onStart(context);
  flown_rounds_ = 0;
  left_out_ = 0;
  arrived_.reset();
}

bool Patrol::next(std::size_t points, std::int64_t rounds) {
  arrived_.reset();
  endLeg();
  if (++at_ < points) return false;
  at_ = 0;
  return ++flown_rounds_ == rounds;
}

Status Patrol::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  const auto path = points_.get();
  const auto rounds = rounds_.get();
  const auto pause = pause_s_.get();
  if (!path) return fail(context, points_.problem());
  if (!rounds) return fail(context, rounds_.problem());
  if (!pause) return fail(context, pause_s_.problem());
  at_ = std::min(at_, path->points.size() - 1);
  if (!arrived_) {
    const Leg leg = flyTo(tick, path->points[at_], tick.mode);
    if (leg.status == Status::kRunning) return leg.status;
    if (leg.status == Status::kFailure) {
      if (++left_out_ == path->points.size()) return fail(context, leg.problem);
      tick.say(common::Severity::kWarning, name() + " skips a point", leg.problem);
      emitHold(tick);
      return next(path->points.size(), *rounds) ? Status::kSuccess : Status::kRunning;
    }
    left_out_ = 0;
    arrived_ = tick.flight.now;
  }
  emitHold(tick);
  if ((tick.flight.now - *arrived_).nanoseconds() < pause->nanoseconds) return Status::kRunning;
  return next(path->points.size(), *rounds) ? Status::kSuccess : Status::kRunning;
}

}  // namespace swiftlet::behaviors
