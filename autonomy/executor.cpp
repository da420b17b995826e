#include "autonomy/executor.hpp"

#include <optional>
#include <utility>
#include <variant>

#include "autonomy/maneuvers/path_flight.hpp"
#include "autonomy/maneuvers/table.hpp"
#include "planning/costs/open_place.hpp"

namespace swiftlet::autonomy {
namespace {

/// The intent's own clearance, or `otherwise_m` if it has none.
double clearanceOf(const common::IntentKind& kind, double otherwise_m) {
  return std::visit(
      [&](const auto& intent) {
        if constexpr (requires { intent.clearance_m; })
          return intent.clearance_m;
        else
          return otherwise_m;
      },
      kind);
}

/// The nearest person who walks; nullopt if nobody does.
std::optional<Eigen::Vector2d> nearestWalking_map_m(const ManeuverInput& input) {
  std::optional<Eigen::Vector2d> nearest_map_m;
  const Eigen::Vector2d here_map_m = input.position_map_m();
  for (const common::DynamicObstacle& person : input.people)
    if (person.moving &&
        (!nearest_map_m || (person.center_map_m - here_map_m).norm() < (*nearest_map_m - here_map_m).norm()))
      nearest_map_m = person.center_map_m;
  return nearest_map_m;
}

}  // namespace

using common::IntentState;
using common::Time;

Executor::Executor(const ExecutorConfig& config, const common::VehicleConfig& vehicle, double grid_resolution_m,
                   control::FlightController& controller, common::JobRunner& jobs, common::EventLog& log,
                   const common::RgbdCameraConfig* camera)
    : config_(config),
      camera_(camera),
      controller_(controller),
      desk_(config.planning, vehicle, grid_resolution_m, jobs,
            [this](const PlanningAnswer& answer, Time now) { receive(answer, now); }),
      retreat_(controller, camera != nullptr),
      memory_(log) {
  begin({});
}

Executor::~Executor() = default;

void Executor::tick(const common::Intent& intent, const ManeuverInput& input) {
  now_ = input.now;
  state_ = input.state;
  names_ = input.names;
  if (input.anybody_walks) memory_.people_seen = now_;
  if (!memory_.person)
    if (const auto walking_map_m = nearestWalking_map_m(input)) memory_.person_map_m = walking_map_m;
  if (intent.id != intent_.id) begin(intent);
  const PathFlight* flight = aim().flight;
  rememberHeights(memory_, flight ? flight->plan() : nullptr, controller_, state_);
  if (maneuver_) note(maneuver_->step(input));
  if (desk_.due(now_)) desk_.ask(planningRequest(input, client(), {}, aim().left_out), now_);
  status_.released = controller_.stopped() && !retreat_.active();
}

void Executor::begin(const common::Intent& intent) {
  maneuver_.reset();
  intent_ = intent;
  status_ = {intent.id, IntentState::kRunning, toString(intent, names_), false};
  if (controller_.state() == common::FlightState::kFlying && !retreat_.active()) controller_.hold();
  controller_.lookAt(std::nullopt);
  maneuver_ =
      makeManeuver(intent.kind, {config_, controller_, desk_, retreat_, memory_, client(), intent.resumes, camera_});
}

void Executor::note(const Progress& progress) {
  status_.state = progress.state;
  if (!progress.reason.empty()) {
    status_.reason = progress.reason;
    status_.inspecting = progress.inspecting;
  }
  if (progress.state == IntentState::kRunning) return;
  maneuver_.reset();
  const bool failed = progress.state == IntentState::kFailed;
  memory_.log.add({now_, failed ? common::Severity::kWarning : common::Severity::kInfo, kFlightSource,
                   toString(intent_, names_) + (failed ? ": failed" : ": done"), progress.reason});
  if (failed && controller_.state() == common::FlightState::kFlying) controller_.hold();
}

void Executor::react(const planning::AvoidanceDecision& decision, const common::VehicleState& state) {
  state_ = state;
  retreat_.react(decision, state);
}

void Executor::receive(const PlanningAnswer& answer, Time now) {
  now_ = now;
  if (maneuver_ && answer.intent_id == intent_.id && !retreat_.active()) note(maneuver_->answered(answer, now, state_));
}

PlanningClient Executor::client() const { return {intent_.id, clearanceOf(intent_.kind, config_.clearance_m)}; }

std::vector<Eigen::Vector2d> Executor::remainingPlan_map_m() const {
  const PathFlight* flight = aim().flight;
  return flight ? flight->remaining_map_m() : std::vector<Eigen::Vector2d>{};
}

Eigen::Vector2d Executor::escape_map_m(const common::VehicleState& state) const {
  const auto map = costMapHere();
  if (!map) return Eigen::Vector2d::Zero();
  const Eigen::Vector2d velocity_map_m_s = state.velocity_map_m_s().head<2>();
  const double speed_m_s = velocity_map_m_s.norm();
  Eigen::Vector2d stopped_m = state.T_map_body_planar().position_m();
  if (speed_m_s > 0.0)
    stopped_m += controller_.follower().brakingDistance_m(common::FlightMode::kCareful, speed_m_s) / speed_m_s *
                 velocity_map_m_s;
  return planning::displacementToOpenPlace_m(*map, stopped_m, control::BlindEscape::kReach_m);
}

}  // namespace swiftlet::autonomy
