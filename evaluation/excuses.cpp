#include "evaluation/excuses.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "evaluation/verdict_facts.hpp"

namespace swiftlet::evaluation {
namespace {

using Text = std::optional<std::string>;

Text textIf(bool applies, const char* text) { return applies ? Text(text) : std::nullopt; }

Text noRoom(const ContactFacts& facts) {
  return textIf(!facts.room_to_take_off, "the hull does not fit between the place and the height of the take-off");
}

Text thrustLost(const ContactFacts& facts) {
  if (facts.thrust_margin >= 1.0 || facts.thrust_margin_before < kLowMargin) return std::nullopt;
  return fmt::format("the thrust fell to {:.2f} times the weight, from {:.2f} when a landing was still possible",
                     facts.thrust_margin, facts.thrust_margin_before);
}

Text unseenGlass(const ContactFacts& facts) { return textIf(facts.unseen_glass, "glass that never returned a beam"); }

Text suddenPerson(const ContactFacts& facts) {
  if (!facts.by_person || !facts.remains) return std::nullopt;
  if (facts.motors_off) return "a person, who walked into it while its motors were off";
  if (!facts.person_in_field_s || *facts.person_in_field_s >= kNotice_s) return std::nullopt;
  return fmt::format("a person, who walked into it {:.1f} s after coming into the field of its laser",
                     *facts.person_in_field_s);
}

constexpr Excuse<ContactFacts> kOfContacts[] = {
    {"The hull does not fit between the place of the take-off and the height that was requested: who takes off there "
     "touches something, and who does not take off flies no mission.",
     noRoom},
    {"The motors no longer carry the weight, and ten seconds before, while a landing was still possible, they did with "
     "a margin.",
     thrustLost},
    {"Glass that never returned a beam cannot be told from air.", unseenGlass},
    {"A person walks into it within 0.6 s of first being in the field of its laser, or while its motors are off, and "
     "would have, too, had it stood or landed from 2 s before: nobody notices and evades in less. A person who never "
     "was in the field came from where it did not look.",
     suddenPerson},
};

Text ordered(const VerdictFacts& facts) { return facts.order.empty() ? std::nullopt : Text(facts.order); }

Text sensorFailed(const VerdictFacts& facts) {
  return facts.faulty_sensor.empty() ? std::nullopt : Text(facts.faulty_sensor + " failed");
}

Text littleThrust(const VerdictFacts& facts) {
  if (facts.thrust_margin >= kLowMargin) return std::nullopt;
  return fmt::format("the thrust was at most {:.2f} times the weight", facts.thrust_margin);
}

Text littleCharge(const VerdictFacts& facts) {
  const double reserve = std::max(kReserveShare, facts.least_charge), home = facts.home_share.value_or(0.0);
  if (facts.charge - home > reserve) return std::nullopt;
  return fmt::format("{:.0f} % of the battery was left, {:.0f} % to fly home and {:.0f} % to keep", 100 * facts.charge,
                     100 * home, 100 * reserve);
}

Text noPath(const VerdictFacts& facts) { return textIf(!facts.goal_reachable, "no path leads to the goal"); }

Text lost(const VerdictFacts& facts) {
  if (facts.position_error_m <= kLostPosition_m) return std::nullopt;
  return fmt::format("the estimated position was {:.2f} m off", facts.position_error_m);
}

Text nothingToSee(const VerdictFacts& facts) {
  return textIf(!facts.position_seen, "the laser saw too little to fix the position");
}

Text noFloor(const VerdictFacts& facts) { return textIf(!facts.floor_seen, "the floor of the take-off was not below"); }

constexpr Excuse<VerdictFacts> kOfEndings[] = {
    {"The operator or the pilot ended the flight.", ordered},
    {"The IMU, the laser or the measurement of the battery had failed: what is left is enough to land by, not to fly "
     "on.",
     sensorFailed},
    {"The thrust at 95 % throttle was below 1.15 times the weight, which leaves nothing to climb with.", littleThrust},
    {"The charge, less what the true path home takes, was at most a fifth of the battery or what the thrust needs.",
     littleCharge},
    {"No path through the true free space leads to the goal.", noPath},
    {"The estimated position was more than 0.5 m off: the vehicle would have missed a door.", lost},
    {"For some seconds the laser saw too little to fix the position.", nothingToSee},
    {"For some seconds the floor of the take-off was not below, so the height was in doubt.", noFloor},
};

template <typename Facts>
Text firstOf(std::span<const Excuse<Facts>> excuses, const Facts& facts) {
  for (const Excuse<Facts>& excuse : excuses)
    if (Text text = excuse.applies(facts)) return text;
  return std::nullopt;
}

}  // namespace

std::span<const Excuse<ContactFacts>> contactExcuses() { return kOfContacts; }
std::span<const Excuse<VerdictFacts>> endingExcuses() { return kOfEndings; }

std::optional<std::string> excuse(const ContactFacts& facts) { return firstOf(contactExcuses(), facts); }
std::optional<std::string> excuse(const VerdictFacts& facts) { return firstOf(endingExcuses(), facts); }

}  // namespace swiftlet::evaluation
