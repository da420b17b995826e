#include "control/failsafe.hpp"

#include <algorithm>

#include "common/check.hpp"

namespace swiftlet::control {

using common::FlightState;
using failsafe_table::kFailsafes;
using failsafe_table::kFindingTexts;

namespace {

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
