#include "autonomy/health/checks.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace swiftlet::autonomy {

using common::Concern;
using control::FindingKind;

namespace {

using Condition = VehicleCondition;
using Config = SupervisorConfig;

/// The time of kUnseenLand_s while other sensors measure the position: what comes near is not seen.
constexpr double kUnseenKnownLand_s = 10.0;
constexpr double kPilotSilent_s = 1.0;
/// A table below passes within this time at 1 m/s; a stairwell does not.
constexpr double kHeightBack_s = 0.5;
/// The height counts as known for this long after a measurement: six scans of a laser at 40 Hz.
constexpr double kHeightSeen_s = 0.15;
/// Height and position are known again once they have been for this long, well over the place where they were found.
constexpr double kKnownAgain_s = 1.0;
/// The position counts as known well up to this share of kDriftBack_m.
constexpr double kKnownShare = 0.5;
/// In the open the vehicle flies back until its drift is this many times that at which it lands inside.
constexpr double kFurtherInTheOpen = 2.0;
/// Safety factor of the charge that the flight home takes: detours and the wind of the shipped natures cost up to a
/// seventh (docs/decisions/fail_safes.md).
constexpr double kHomeNeedFactor = 1.15;
/// Home is out of reach when less than this share of what it takes is left: predictions differ from the truth, and from
/// each other, by some percent.
constexpr double kClearly = 0.8;
/// A person whom one scan makes of a chair is gone within this time; one who comes walks 0.4 m.
constexpr double kAllRound_s = 0.3;
/// A gust may take the margin for a moment.
constexpr double kThrustMargin_s = 1.0;

Reading above(double value, double bound) { return {value, bound, value > bound}; }
Reading below(double value, double bound) { return {value, bound, value < bound}; }
Reading atMost(double value, double bound) { return {value, bound, value <= bound}; }
Reading unlessEmpty(const std::string& why) { return {why.empty() ? 0.0 : 1.0, 0.0, !why.empty()}; }

bool onGround(const Condition& condition) {
  return control::phaseOf(condition.flight) == control::FlightPhase::kOnGround;
}

double landShare(const Condition& condition, const Config& config) {
  return std::max(config.battery_land_share, condition.energy.land_share);
}

std::string chargeLeft(const Condition& condition) {
  return fmt::format("{:.0f} % of the battery left", 100.0 * condition.energy.battery_remaining);
}

std::string minutesLeft(const Condition& condition, const Config&) {
  const auto& seconds = condition.energy.seconds_left;
  return seconds ? fmt::format("{:.1f} min until it lands", *seconds / 60.0) : std::string();
}

std::string noScan(const Condition& condition, const Config&) {
  return fmt::format("no scan for {:.2f} s{}", condition.unseen_s,
                     condition.position_measured ? "; other sensors measure the position" : "");
}

std::string positionUncertain(const Condition& condition, const Config&) {
  return fmt::format("the position is uncertain by {:.1f} m", condition.drift_m);
}

/// Without a known share for the flight home there is none to keep.
Reading chargeForHome(const Condition& condition, const Config& config, bool) {
  if (!condition.energy.home_share || condition.lands || condition.goes_home) return {};
  const double left = condition.energy.battery_remaining - landShare(condition, config) - config.home_reserve_share;
  return atMost(left, kHomeNeedFactor * *condition.energy.home_share);
}

std::string turnedBack(const Condition& condition, const Config& config) {
  const common::EnergyLayer& energy = condition.energy;
  const double land_share = landShare(condition, config);
  return fmt::format(
      "turned back with {:.0f} % of the battery left, {:.0f} % to fly {:.1f} m home{}, and {:.0f} % at which {}",
      100.0 * energy.battery_remaining, 100.0 * *energy.home_share, energy.home_m.value_or(0.0),
      energy.home_planned ? "" : " along its trail, as no path is known", 100.0 * land_share,
      land_share > config.battery_land_share ? "the thrust carries the weight no longer" : "it lands");
}

/// During the flight home: the vehicle flies as far as the charge goes, and lands there.
Reading homeOutOfReach(const Condition& condition, const Config& config, bool) {
  const common::EnergyLayer& energy = condition.energy;
  if (!energy.home_share || !energy.home_planned || condition.lands) return {};
  return atMost(energy.battery_remaining - landShare(condition, config), kClearly * *energy.home_share);
}

std::string outOfReach(const Condition& condition, const Config& config) {
  const common::EnergyLayer& energy = condition.energy;
  const double left = energy.battery_remaining - landShare(condition, config);
  return fmt::format("{:.0f} % to fly {:.1f} m home, {:.0f} % left to fly with: it lands on the way",
                     100.0 * *energy.home_share, energy.home_m.value_or(0.0), 100.0 * std::max(0.0, left));
}

/// Before a take-off some charge must be left over to fly with.
Reading chargeSpent(const Condition& condition, const Config& config, bool) {
  return below(condition.energy.battery_remaining,
               config.battery_land_share + (onGround(condition) ? config.home_reserve_share : 0.0));
}

std::string chargeSpentWhy(const Condition& condition, const Config& config) {
  if (!onGround(condition)) return chargeLeft(condition);
  return fmt::format("{:.0f} % of the battery are left; {:.0f} % are needed, and it lands at {:.0f} %",
                     100.0 * condition.energy.battery_remaining,
                     100.0 * (config.battery_land_share + config.home_reserve_share),
                     100.0 * config.battery_land_share);
}

/// A margin of 0 is not known yet.
Reading thrustSpent(const Condition& condition, const Config& config, bool) {
  const double margin = condition.energy.thrust_margin;
  return {margin, config.least_thrust_margin, margin > 0.0 && margin < config.least_thrust_margin};
}

std::string thrustSpentWhy(const Condition& condition, const Config& config) {
  const double margin = condition.energy.thrust_margin;
  if (!onGround(condition)) return fmt::format("the thrust is at most {:.2f} times the weight", margin);
  return fmt::format("the thrust is at most {:.2f} times the weight; {:.2f} is needed", margin,
                     config.least_thrust_margin);
}

/// While nothing is seen at all, this is not found, as the rules of that come first: the mirror that looks down is part
/// of the laser. Nor does it end then, as the height is not known again.
Reading heightUnmeasured(const Condition& condition, const Config&, bool active) {
  if (!active && condition.unseen_s > kUnseenHold_s) return {};
  return above(condition.vertical_age_s, active ? kHeightSeen_s : kHeightBack_s);
}

constexpr Check kAllChecks[] = {
    {FindingKind::kPilotSilent, 0.0, 0.0,
     [](const Condition& c, const Config&, bool) { return above(c.pilot_silent_s, kPilotSilent_s); },
     [](const Condition&, const Config&) {
       return fmt::format("no sample from the pilot for {:.1f} s; the vehicle holds until Resume or Land",
                          kPilotSilent_s);
     },
     Concern::kPilot},
    {FindingKind::kSurroundingsUnseen, 0.0, 0.0,
     [](const Condition& c, const Config&, bool) { return above(c.unseen_s, kUnseenHold_s); }, noScan,
     Concern::kSurroundings},
    {FindingKind::kSurroundingsLost, 0.0, 0.0,
     [](const Condition& c, const Config&, bool) {
       return above(c.unseen_s, c.position_measured ? kUnseenKnownLand_s : kUnseenLand_s);
     },
     [](const Condition& c, const Config&) { return fmt::format("no scan for {:.1f} s", c.unseen_s); },
     Concern::kLanding},
    {FindingKind::kSensorContradicted, 0.0, 0.0,
     [](const Condition& c, const Config&, bool) { return unlessEmpty(c.sensor_lies); },
     [](const Condition& c, const Config&) { return c.sensor_lies; }, Concern::kLanding},
    {FindingKind::kGaugeUnusable, 0.0, 0.0,
     [](const Condition& c, const Config&, bool) { return unlessEmpty(c.gauge_fault); },
     [](const Condition& c, const Config&) { return c.gauge_fault; }, Concern::kNone},
    {FindingKind::kChargeBelow30, 0.0, 0.0,
     [](const Condition& c, const Config&, bool) { return atMost(c.energy.battery_remaining, 0.3); }, minutesLeft,
     Concern::kLowBattery},
    {FindingKind::kChargeBelow20, 0.0, 0.0,
     [](const Condition& c, const Config&, bool) { return atMost(c.energy.battery_remaining, 0.2); }, minutesLeft,
     Concern::kLowBattery},
    {FindingKind::kChargeForHome, 0.0, 0.0, chargeForHome, turnedBack, Concern::kTurnBack},
    {FindingKind::kHomeOutOfReach, 0.0, 0.0, homeOutOfReach, outOfReach, Concern::kHome},
    {FindingKind::kThrustSpent, kThrustMargin_s, 0.0, thrustSpent, thrustSpentWhy, Concern::kLanding},
    {FindingKind::kPeopleAllRound, kAllRound_s, 0.0,
     [](const Condition& c, const Config&, bool) { return unlessEmpty(c.people_all_round); },
     [](const Condition& c, const Config&) { return c.people_all_round; }, Concern::kLanding},
    {FindingKind::kChargeSpent, 0.0, 0.0, chargeSpent, chargeSpentWhy, Concern::kLanding},
    {FindingKind::kBatteryUnmeasured, 0.0, 0.0,
     [](const Condition& c, const Config&, bool) {
       return Reading{c.energy.battery_voltage_v, 0.0, !(c.energy.battery_voltage_v > 0.0)};
     },
     [](const Condition&, const Config&) { return std::string("the battery has not been measured"); }, Concern::kNone},
    {FindingKind::kHeightUnmeasured, 0.0, kKnownAgain_s, heightUnmeasured,
     [](const Condition& c, const Config&) {
       return fmt::format("the surface below has not been measured for {:.1f} s", c.vertical_age_s);
     },
     Concern::kPosition},
    {FindingKind::kPositionUncertain, 0.0, kKnownAgain_s,
     [](const Condition& c, const Config&, bool active) {
       return above(c.drift_m, active ? kKnownShare * kDriftBack_m : kDriftBack_m);
     },
     positionUncertain, Concern::kPosition},
    {FindingKind::kPositionLost, 0.0, 0.0,
     [](const Condition& c, const Config&, bool) {
       return above(c.drift_m, kDriftLand_m * (c.walls_around ? 1.0 : kFurtherInTheOpen));
     },
     positionUncertain, Concern::kLanding},
};

}  // namespace

double spareTime_s(const common::EnergyLayer& energy, const SupervisorConfig& config) {
  constexpr double kGivesUp_s = 5.0;  // So that the mission decides before the supervisor does.
  const double land_share = std::max(config.battery_land_share, energy.land_share);
  const double left = energy.battery_remaining - land_share;
  if (!energy.seconds_left || !energy.home_share) return std::numeric_limits<double>::infinity();
  if (!(left > 0.0)) return 0.0;
  const double spare = left - config.home_reserve_share - kHomeNeedFactor * *energy.home_share;
  return *energy.seconds_left * spare / left - kGivesUp_s;
}

std::span<const Check> checks() { return kAllChecks; }

}  // namespace swiftlet::autonomy
