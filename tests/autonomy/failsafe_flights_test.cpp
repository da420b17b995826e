// The table of fail-safes in the air: a fault that causes a finding begins in a phase of a flight, and what the vehicle
// does is compared with the row of that finding and phase. Twelve cells are drawn by a seed; SWIFTLET_ALL_FAILSAFES=1
// flies all that a single fault can cause in a room. What it cannot (a lost or uncertain position, a spent thrust, home
// out of reach) is told to the supervisor in supervisor_test.cpp.
#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/random.hpp"
#include "control/failsafe.hpp"
#include "tests/autonomy/autonomy_story.hpp"

namespace swiftlet::autonomy {
namespace {

using common::ImuSample;
using common::SensorEvent;
using control::FindingKind;
using control::FlightPhase;
using control::Response;
using Hand = HandledVehicle::Hand;
using Scan = std::shared_ptr<const common::LaserScan>;

bool carriesScan(const SensorEvent& event) { return std::holds_alternative<Scan>(event); }

/// Changes each range of a scan, by its beam.
template <typename Change>
Hand ranges(Change change) {
  return [change](SensorEvent& event) mutable {
    if (!carriesScan(event)) return true;
    auto scan = std::make_shared<common::LaserScan>(*std::get<Scan>(event));
    for (std::size_t beam = 0; beam < scan->ranges_m.size(); ++beam) change(beam, scan->ranges_m[beam]);
    event = Scan(std::move(scan));
    return true;
  };
}

Hand charge(double remaining) {
  return [remaining](SensorEvent& event) {
    if (auto* battery = std::get_if<common::BatterySample>(&event)) battery->remaining = remaining;
    return true;
  };
}

/// The pilot takes over in the place of the next sample of the battery, and is not heard of again.
Hand silentPilot() {
  return [taken = false](SensorEvent& event) mutable {
    const auto* battery = std::get_if<common::BatterySample>(&event);
    if (battery == nullptr || taken) return true;
    taken = true;
    common::PilotSample pilot;
    pilot.stamps = battery->stamps;
    pilot.takes_over = true;
    event = pilot;
    return true;
  };
}

bool wrongForce(SensorEvent& event) {
  if (auto* imu = std::get_if<ImuSample>(&event)) imu->specific_force_body_m_s2.z() += 6.0;
  return true;
}

/// What causes the findings that a fault of a sensor or of the motors can cause in this room.
std::map<FindingKind, Hand> faults() {
  const common::LaserConfig laser = storyScenario().laser;
  const auto down = [laser](std::size_t beam) {
    const auto first = static_cast<std::size_t>(laser.mirror_first_beam);
    return beam >= first && beam < first + static_cast<std::size_t>(laser.mirror_beams);
  };
  constexpr float kNone = std::numeric_limits<float>::infinity();
  return {
      {FindingKind::kInertialUnusable, [](SensorEvent& event) { return !std::holds_alternative<ImuSample>(event); }},
      {FindingKind::kSensorContradicted, wrongForce},
      {FindingKind::kEstimateDiverged, wrongForce},
      {FindingKind::kSurroundingsUnseen, [](SensorEvent& event) { return !carriesScan(event); }},
      {FindingKind::kSurroundingsLost, [](SensorEvent& event) { return !carriesScan(event); }},
      {FindingKind::kHeightUnmeasured, ranges([down](std::size_t beam, float& range_m) {
         if (down(beam)) range_m = kNone;
       })},
      {FindingKind::kHeightLost, ranges([down](std::size_t beam, float& range_m) {
         if (down(beam)) range_m = kNone;
       })},
      {FindingKind::kChargeSpent, charge(0.1)},
      {FindingKind::kChargeForHome, charge(0.142)},
      {FindingKind::kChargeBelow30, charge(0.25)},
      {FindingKind::kChargeBelow20, charge(0.18)},
      {FindingKind::kBatteryUnmeasured,
       [](SensorEvent& event) { return !std::holds_alternative<common::BatterySample>(event); }},
      {FindingKind::kGaugeUnusable,
       [](SensorEvent& event) { return !std::holds_alternative<common::BatterySample>(event); }},
      {FindingKind::kPilotSilent, silentPilot()},
  };
}

struct Cell {
  FindingKind finding;
  FlightPhase phase;
  Response response;

  std::string name() const {
    return std::string(toString(finding)) + " " + std::string(toString(phase)) + ": " + std::string(toString(response));
  }
};

/// False where the fault causes something else before: without the mirror a vehicle that flies turns back, and one that
/// lands has landed; near the ground the thrust is no reference, so a wrong force makes the estimate diverge. A vehicle
/// that stands without a sensor is never ready, so that nothing has to be refused.
bool canBe(FindingKind finding, FlightPhase phase) {
  switch (phase) {
    case FlightPhase::kOnGround:
      return finding == FindingKind::kBatteryUnmeasured || finding == FindingKind::kChargeSpent ||
             finding == FindingKind::kPilotSilent;
    case FlightPhase::kTakingOff:
      return finding != FindingKind::kSensorContradicted;
    case FlightPhase::kFlying:
      return finding != FindingKind::kHeightLost && finding != FindingKind::kEstimateDiverged;
    case FlightPhase::kLanding:
      return finding != FindingKind::kHeightLost && finding != FindingKind::kEstimateDiverged &&
             finding != FindingKind::kGaugeUnusable;
  }
  return false;
}

std::vector<Cell> cells() {
  std::vector<Cell> all;
  const auto known = faults();
  for (const control::Failsafe& row : control::failsafes())
    for (const FlightPhase phase : control::kFlightPhases)
      if (row.phases[static_cast<std::size_t>(phase)] && known.contains(row.finding) && canBe(row.finding, phase))
        all.push_back({row.finding, phase, row.response});
  return all;
}

/// True once the vehicle has done, or said, what that response is.
bool responded(const AutonomyStory& story, const Cell& cell) {
  const auto says = [&](const char* source, const std::string& text) {
    return story.event(source, text) != story.events.end();
  };
  const FlightState flight = story.world().vehicle->flight_state;
  switch (cell.response) {
    case Response::kRefuseTakeOff:
      return story.autonomy().missionStatus().state == MissionState::kFailed && flight != FlightState::kTakingOff;
    case Response::kWarn:
      return says("supervisor", cell.finding == FindingKind::kGaugeUnusable   ? "the charge is estimated"
                                : cell.finding == FindingKind::kChargeBelow30 ? "25 %"
                                                                              : "18 %");
    case Response::kFlyHome:
      return says("supervisor", "turn back");
    case Response::kLand:
      return says("supervisor", "land") || says("flight", "landing");
    case Response::kDescend:
      return flight == FlightState::kEmergencyLanding;
    case Response::kHold:
      return std::any_of(story.events.begin(), story.events.end(), [&](const common::Event& event) {
        const char* why = cell.finding == FindingKind::kPilotSilent ? "no sample from the pilot" : "no scan";
        return event.text == "hold" && event.reason.starts_with(why);
      });
    default:
      return says("supervisor", std::string(toString(cell.response)));
  }
}

/// Before a take-off the fault is there from the start on.
void fly(const Cell& cell) {
  AutonomyStory story(cell.phase == FlightPhase::kLanding
                          ? R"(<TakeOff height_m="1.2"/><Land/>)"
                          : R"(<TakeOff height_m="1.0"/><MoveToGoal goal="2.5;-2.0"/><MoveToGoal goal="-2.5;2.0"/>)");
  const FlightState begins = cell.phase == FlightPhase::kLanding  ? FlightState::kLanding
                             : cell.phase == FlightPhase::kFlying ? FlightState::kFlying
                                                                  : FlightState::kTakingOff;
  if (cell.phase != FlightPhase::kOnGround) {
    ASSERT_TRUE(story.until([&] { return story.world().vehicle->flight_state == begins; }, 20.0)) << cell.name();
  }
  story.events.clear();
  story.hand = faults().at(cell.finding);
  std::string told = cell.name();
  const bool done = story.until([&] { return responded(story, cell); }, 12.0);
  for (const common::Event& event : story.events)
    told += "\n  " + event.source + ": " + event.text + " (" + event.reason + ")";
  EXPECT_TRUE(done) << told;
}

TEST(FailsafeFlights, DoWhatTheTableSays) {
  std::vector<Cell> drawn = cells();
  common::RandomStream random(2026, "failsafe cells", 0);
  if (std::getenv("SWIFTLET_ALL_FAILSAFES") == nullptr) {
    for (std::size_t i = 0; i < 12; ++i)
      std::swap(drawn[i],
                drawn[i + static_cast<std::size_t>(random.uniform() * static_cast<double>(drawn.size() - i))]);
    drawn.resize(12);
  }
  for (const Cell& cell : drawn) {
    SCOPED_TRACE(cell.name());
    fly(cell);
  }
}

}  // namespace
}  // namespace swiftlet::autonomy
