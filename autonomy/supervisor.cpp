#include "autonomy/supervisor.hpp"

#include <utility>

#include <fmt/format.h>

#include "control/flight_state_machine.hpp"

namespace swiftlet::autonomy {

using common::Time;
using control::FindingKind;
using control::Response;

namespace {

constexpr const char* kSupervisor = "supervisor";

/// The event of a finding, with what is done about it.
std::string headlineOf(const Finding& finding) {
  const Response response = finding.row->response;
  if (response == Response::kFlyHome) return "turn back";
  if (response != Response::kWarn) return std::string(control::toString(response));
  switch (finding.row->finding) {
    case FindingKind::kChargeBelow30:
    case FindingKind::kChargeBelow20:
      return fmt::format("{:.0f} % of the battery left", 100.0 * finding.reading.value);
    case FindingKind::kHomeOutOfReach:
      return "home is out of reach";
    case FindingKind::kGaugeUnusable:
      return "the charge is estimated by the current drawn";
    default:
      return std::string(control::toString(finding.row->finding));
  }
}

}  // namespace

std::string_view phaseOf(const Supervision& supervision) {
  if (supervision.land) return "land";
  if (supervision.back > 0) return "fly back along the trail";
  if (supervision.home > 0) return "fly home";
  return supervision.hold ? "hold" : "";
}

std::optional<common::CommandResult> Supervisor::take(const common::OperatorCommand& command, Time now) {
  const common::CommandResult accepted{command.id, true, {}};
  if (std::holds_alternative<common::HoldCommand>(command.kind)) {
    operator_holds_ = true;
    home_.active = home_.forced();  // A flight home for the charge continues after Resume.
    return accepted;
  }
  if (std::holds_alternative<common::ResumeCommand>(command.kind)) return resume(command.id);
  if (std::holds_alternative<common::LandCommand>(command.kind)) {
    if (!supervision_.land) landed_by_operator_ = true;
    land(now, "the operator asked for it", common::Concern::kNone);
    return accepted;
  }
  return std::nullopt;
}

common::CommandResult Supervisor::resume(std::uint64_t id) {
  const bool held = std::exchange(operator_holds_, false);
  if (home_.forced()) return {id, held, "it flies home: " + home_.reason};
  if (!held && !home_.active) {
    const std::string reason = holdReason();
    return {id, false, reason.empty() ? "nothing is on hold" : reason + ": that hold ends by itself"};
  }
  home_.active = false;
  return {id, true, {}};
}

common::CommandResult Supervisor::goHome(const common::OperatorCommand& command, AtHome then) {
  if (flight_ != common::FlightState::kFlying)
    return {command.id, false, fmt::format("the vehicle is not flying: {}", common::toString(flight_))};
  startHome(home_.reason, then);
  return {command.id, true,
          then == AtHome::kHold ? "the mission holds meanwhile, and goes on after Resume"
                                : "the vehicle holds there until a mission is started"};
}

void Supervisor::startHome(std::string reason, AtHome then) {
  home_ = {true, std::move(reason), home_.count + 1, then};
  operator_holds_ = false;
}

void Supervisor::missionFailed(Time now, std::string reason) {
  log_.warn(now, "mission", "the mission has failed: the vehicle flies home", reason, common::Concern::kHome);
  startHome("the mission has failed");
}

void Supervisor::homeEnded(Time now, bool reached, std::string reason) {
  home_.active = false;
  if (!home_.reason.empty())
    return land(now, reached ? "home reached, " + home_.reason : home_.reason + "; home not reached: " + reason);
  operator_holds_ = home_.then == AtHome::kHold;
  const std::string holds = operator_holds_ ? "the vehicle holds until Resume or Land"
                                            : "the vehicle holds until a mission is started, or it lands";
  if (reached) return log_.info(now, kSupervisor, "home reached", holds);
  log_.warn(now, kSupervisor, "home not reached", std::move(reason), common::Concern::kHome);
}

std::string Supervisor::refusal(const common::OperatorCommand& command) const {
  if (!control::isAirborne(flight_) || std::holds_alternative<common::LandCommand>(command.kind)) return {};
  if (supervision_.land) return "the vehicle is landing: " + supervision_.land_reason;
  if (flight_ == common::FlightState::kLanding || flight_ == common::FlightState::kEmergencyLanding)
    return "the vehicle is landing";
  const bool leads_elsewhere = std::holds_alternative<common::GoalCommand>(command.kind) ||
                               std::holds_alternative<common::HomeCommand>(command.kind) ||
                               std::holds_alternative<common::StartMissionCommand>(command.kind);
  return home_.forced() && leads_elsewhere ? "the vehicle flies home and lands there: " + home_.reason : "";
}

void Supervisor::pilotArrived(Time now, bool takes_over) {
  pilot_heard_ = now;
  if (takes_over == pilot_flies_) return;
  pilot_flies_ = takes_over;
  log_.warn(now, kSupervisor, takes_over ? "hold" : "resume",
            takes_over ? "the pilot took over" : "the pilot gave control back", common::Concern::kPilot);
}

const Supervision& Supervisor::tick(Time now, VehicleCondition condition) {
  flight_ = condition.flight;
  if (last_sight_ && control::isAirborne(flight_)) condition.unseen_s = (now - *last_sight_).seconds();
  if (pilot_flies_) condition.pilot_silent_s = (now - pilot_heard_).seconds();
  health_.update(now, condition);
  for (const Finding& finding : health_.entered()) begin(now, finding);
  for (const FindingKind what : health_.left()) end(now, what);
  followPlace(now);

  supervision_.unseen = health_.find(FindingKind::kSurroundingsUnseen) != nullptr;
  supervision_.hold_reason = holdReason();
  supervision_.hold = !supervision_.hold_reason.empty();
  const Response response = activeResponse();
  const bool may_fly = !pilot_flies_ && !operator_holds_;
  supervision_.back = may_fly && response == Response::kFlyBack ? flights_back_ : 0;
  // The operator's flight home is none of the table's, and goes on as long as nothing above it is active.
  supervision_.home = may_fly && home_.active && response <= Response::kFlyHome ? home_.count : 0;
  supervision_.take_off_refusal = takeOffRefusal();
  supervision_.flown_by = flownBy();
  return supervision_;
}

/// Does and tells what the row of the finding says. A vehicle that lands for good is only told of more.
void Supervisor::begin(Time now, const Finding& finding) {
  const Response response = finding.row->response;
  if (response == Response::kLand) return land(now, finding.why);
  if (response == Response::kFlyBack) return;  // Of two that are unknown one begins the flight: followPlace.
  if (response == Response::kFlyHome) startHome(finding.why);
  // After the pilot's last sample it is unknown who flies. A hold is right for both: a pilot's sticks override it, and
  // without a pilot the vehicle stays where it is, instead of going on with the mission that the pilot took it from.
  if (finding == FindingKind::kPilotSilent) pilot_flies_ = false;
  if (finding.row->ends == control::Ends::kOnResume) operator_holds_ = true;
  log_.warn(now, kSupervisor, headlineOf(finding), finding.why, finding.concern);
}

void Supervisor::end(Time now, FindingKind what) {
  if (what == FindingKind::kSurroundingsUnseen) log_.info(now, kSupervisor, "scans are back");
  if (what == FindingKind::kGaugeUnusable) log_.info(now, kSupervisor, "battery gauge trusted again");
}

/// A flight back begins when height or position is unknown, and ends when both have been known for some time.
void Supervisor::followPlace(Time now) {
  const bool known = health_.find(FindingKind::kHeightUnmeasured) == nullptr &&
                     health_.find(FindingKind::kPositionUncertain) == nullptr;
  if (std::exchange(flies_back_, flies_back_ && !known && !supervision_.land) && known && !supervision_.land &&
      flight_ == common::FlightState::kFlying)
    log_.info(now, kSupervisor, "height and position are known again");
  const Finding* unknown = unknownPlace();
  if (unknown == nullptr || flies_back_ || supervision_.land) return;
  flies_back_ = true;
  ++flights_back_;
  log_.warn(now, kSupervisor, std::string(control::toString(Response::kFlyBack)), unknown->why, unknown->concern);
}

/// What is beyond its bound of height and position; null if neither is.
const Finding* Supervisor::unknownPlace() const {
  for (const FindingKind what : {FindingKind::kHeightUnmeasured, FindingKind::kPositionUncertain})
    if (const Finding* finding = health_.find(what); finding != nullptr && finding->reading.beyond) return finding;
  return nullptr;
}

/// That of the highest row of the table among the findings. A flight back that has ended is not active though its
/// finding remains for a moment.
Response Supervisor::activeResponse() const {
  Response highest = Response::kNone;
  for (const Finding& finding : health_.findings())
    if (flies_back_ || finding.row->response != Response::kFlyBack) highest = std::max(highest, finding.row->response);
  return highest;
}

std::string Supervisor::takeOffRefusal() const {
  if (control::isAirborne(flight_)) return {};
  for (const control::Failsafe& row : control::failsafes()) {
    if (row.response != Response::kRefuseTakeOff) continue;
    if (const Finding* finding = health_.find(row.finding)) return finding->why;
  }
  return {};
}

void Supervisor::backEnded(Time now) {
  flies_back_ = false;
  if (const Finding* unknown = unknownPlace()) land(now, unknown->why + ", also after flying back");
}

std::string Supervisor::holdReason() const {
  if (pilot_flies_) return "the pilot flies";
  if (supervision_.unseen) return "the laser is silent";
  if (operator_holds_)
    return flies_back_ ? "the operator holds, and it would fly back along its trail" : "the operator holds";
  if (flies_back_) return "it flies back along its trail";
  if (home_.active) return home_.reason.empty() ? "the operator sent it home" : home_.reason;
  return "";
}

/// In the order of holdReason().
common::FlownBy Supervisor::flownBy() const {
  if (supervision_.land) return landed_by_operator_ ? common::FlownBy::kOperator : common::FlownBy::kSupervisor;
  if (pilot_flies_) return common::FlownBy::kPilot;
  if (supervision_.unseen) return common::FlownBy::kSupervisor;
  if (operator_holds_) return common::FlownBy::kOperator;
  if (flies_back_ || home_.forced()) return common::FlownBy::kSupervisor;
  return home_.active ? common::FlownBy::kOperator : common::FlownBy::kMission;
}

void Supervisor::land(Time now, std::string reason, common::Concern concern) {
  if (supervision_.land) return;
  supervision_.land = true;
  supervision_.land_reason = reason;
  log_.warn(now, kSupervisor, "land", std::move(reason), concern);
}

}  // namespace swiftlet::autonomy
