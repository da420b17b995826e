#include "control/failsafe.hpp"

#include <algorithm>

#include "common/check.hpp"

namespace swiftlet::control {

using common::FlightState;

namespace {

using Phases = std::array<bool, kFlightPhases.size()>;
constexpr Phases kGround{true, false, false, false}, kAir{false, true, true, true},
    kUpAndFlying{false, true, true, false}, kInFlight{false, false, true, false}, kAlways{true, true, true, true};

using enum FindingKind;

/// Rows of equal responses are ranked by their order.
constexpr Failsafe kFailsafes[] = {
    {kEstimateDiverged, kGround, Response::kMotorsOff, Ends::kNever},
    {kEstimateDiverged, kAir, Response::kDescend, Ends::kNever},
    {kHeightLost, kAir, Response::kDescend, Ends::kNever},
    {kInertialUnusable, kAir, Response::kDescend, Ends::kNever},
    {kSensorContradicted, kAir, Response::kLand, Ends::kNever},
    {kHorizontalLost, kUpAndFlying, Response::kLand, Ends::kNever},
    {kSurroundingsLost, kAir, Response::kLand, Ends::kNever},
    {kPositionLost, kInFlight, Response::kLand, Ends::kNever},
    {kChargeSpent, kAir, Response::kLand, Ends::kNever},
    {kThrustSpent, kInFlight, Response::kLand, Ends::kNever},
    {kSurroundingsUnseen, kAir, Response::kHold, Ends::kWithFinding},
    {kPilotSilent, kAlways, Response::kHold, Ends::kOnResume},
    {kHeightUnmeasured, kInFlight, Response::kFlyBack, Ends::kWithFinding, Response::kLand},
    {kPositionUncertain, kInFlight, Response::kFlyBack, Ends::kWithFinding, Response::kLand},
    {kChargeForHome, kInFlight, Response::kFlyHome, Ends::kNever, Response::kLand},
    {kBatteryUnmeasured, kGround, Response::kRefuseTakeOff, Ends::kWithFinding},
    {kThrustSpent, kGround, Response::kRefuseTakeOff, Ends::kWithFinding},
    {kChargeSpent, kGround, Response::kRefuseTakeOff, Ends::kWithFinding},
    {kInertialUnusable, kGround, Response::kRefuseTakeOff, Ends::kWithFinding},
    {kHeightLost, kGround, Response::kRefuseTakeOff, Ends::kWithFinding},
    {kHorizontalLost, kGround, Response::kRefuseTakeOff, Ends::kWithFinding},
    {kChargeCountedOn, kAir, Response::kWarn, Ends::kWithFinding},
    {kChargeBelow30, kAir, Response::kWarn, Ends::kNever},
    {kChargeBelow20, kAir, Response::kWarn, Ends::kNever},
    {kHomeOutOfReach, kInFlight, Response::kWarn, Ends::kNever},
};

static_assert(std::is_sorted(std::begin(kFailsafes), std::end(kFailsafes),
                             [](const Failsafe& a, const Failsafe& b) { return a.response > b.response; }),
              "the rows stand by rank");

/// A finding in words: its name, and when it is found.
struct FindingText {
  FindingKind finding;
  std::string_view name, meaning;
};

constexpr FindingText kFindingTexts[] = {
    {kEstimateDiverged, "estimate diverged", "Innovations or covariances of the fusion are impossible."},
    {kHeightLost, "height lost", "There is no valid height for 0.3 s."},
    {kInertialUnusable, "inertial unusable", "Inertial samples are missing, not finite, old or repeated for 0.2 s."},
    {kSensorContradicted, "sensor contradicted",
     "Inertial samples have contradicted the AHRS or the thrust for 1.5 s and are replaced."},
    {kHorizontalLost, "horizontal lost", "There is no valid horizontal position for 1.0 s."},
    {kSurroundingsLost, "surroundings lost",
     "No sensor has seen the surroundings for 1 s, or for 10 s while other sensors measure the position."},
    {kPositionLost, "position lost", "The position is uncertain by more than 2 m, in the open 4 m."},
    {kChargeSpent, "charge spent",
     "The charge is below `battery_land_share`, before a take-off below that and `home_reserve_share`."},
    {kThrustSpent, "thrust spent",
     "The greatest thrust has been below `least_thrust_margin` times the weight for 1 s."},
    {kSurroundingsUnseen, "surroundings unseen", "No sensor has seen the surroundings for 0.3 s."},
    {kPilotSilent, "pilot silent", "A pilot who flies has not been heard of for 1 s."},
    {kHeightUnmeasured, "height unmeasured", "The surface below has not been measured for 0.5 s."},
    {kPositionUncertain, "position uncertain", "The position is uncertain by more than 1 m."},
    {kChargeForHome, "charge for home",
     "The charge suffices for 1.15 times the flight home and `home_reserve_share`, and no longer."},
    {kHomeOutOfReach, "home out of reach", "The charge is less than 0.8 times what the flight home takes."},
    {kBatteryUnmeasured, "battery unmeasured", "The battery has sent no sample yet."},
    {kChargeBelow30, "charge below 30", "The charge is 30 % or less."},
    {kChargeBelow20, "charge below 20", "The charge is 20 % or less."},
    {kChargeCountedOn, "charge counted on",
     "The gauge of the battery is silent or stands still: the charge is counted on by the current."},
};

const FindingText& textOf(FindingKind finding) {
  const auto text = std::ranges::find(kFindingTexts, finding, &FindingText::finding);
  SWIFTLET_CHECK(text != std::end(kFindingTexts), static_cast<int>(finding));
  return *text;
}

}  // namespace

FlightPhase phaseOf(FlightState state) {
  switch (state) {
    case FlightState::kPreparation:
    case FlightState::kPoweredOff:
    case FlightState::kLanded:
      return FlightPhase::kOnGround;
    case FlightState::kTakingOff:
      return FlightPhase::kTakingOff;
    case FlightState::kFlying:
      return FlightPhase::kFlying;
    case FlightState::kLanding:
    case FlightState::kEmergencyLanding:
      return FlightPhase::kLanding;
  }
  SWIFTLET_CHECK(false, static_cast<int>(state));
  return FlightPhase::kOnGround;
}

std::span<const Failsafe> failsafes() { return kFailsafes; }

const Failsafe* failsafeFor(FindingKind finding, FlightPhase phase) {
  const auto row = std::find_if(std::begin(kFailsafes), std::end(kFailsafes), [&](const Failsafe& one) {
    return one.finding == finding && one.phases[static_cast<std::size_t>(phase)];
  });
  return row == std::end(kFailsafes) ? nullptr : row;
}

const Failsafe* activeFailsafe(std::span<const FindingKind> findings, FlightPhase phase) {
  const Failsafe* active = nullptr;
  for (const FindingKind finding : findings) {
    const Failsafe* row = failsafeFor(finding, phase);
    // Rows stand by rank, so the row that comes first in the table has the higher one.
    if (row != nullptr && (active == nullptr || row < active)) active = row;
  }
  return active;
}

std::string_view toString(FindingKind finding) { return textOf(finding).name; }

std::string_view meaning(FindingKind finding) { return textOf(finding).meaning; }

std::string_view toString(Response response) {
  constexpr std::array<std::string_view, kResponses> kNames{
      "nothing", "warn",    "refuse the take-off", "fly home", "fly back along the trail", "hold",
      "land",    "descend", "motors off"};
  return kNames.at(static_cast<std::size_t>(response));
}

std::string_view toString(FlightPhase phase) {
  constexpr std::array<std::string_view, kFlightPhases.size()> kNames{"on the ground", "taking off", "flying",
                                                                      "landing"};
  return kNames.at(static_cast<std::size_t>(phase));
}

std::string_view toString(Ends ends) {
  switch (ends) {
    case Ends::kWithFinding:
      return "with the finding";
    case Ends::kOnResume:
      return "when the operator resumes";
    case Ends::kNever:
      return "not in this flight";
  }
  SWIFTLET_CHECK(false, static_cast<int>(ends));
  return {};
}

std::string_view operatorCan(const Failsafe& row) {
  if (row.ends == Ends::kOnResume) return "resume, land it, fly it by hand";
  switch (row.response) {
    case Response::kNone:
    case Response::kWarn:
      return "everything";
    case Response::kRefuseTakeOff:
      return "mend the cause and take off";
    case Response::kFlyHome:
    case Response::kFlyBack:
      return "hold it, land it, fly it by hand";
    case Response::kHold:
      return "land it, fly it by hand";
    case Response::kLand:
    case Response::kDescend:
      return "fly it by hand";
    case Response::kMotorsOff:
      return "mend the cause";
  }
  SWIFTLET_CHECK(false, static_cast<int>(row.response));
  return {};
}

}  // namespace swiftlet::control
