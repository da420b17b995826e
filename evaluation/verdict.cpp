#include "evaluation/verdict.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace swiftlet::evaluation {
namespace {

Judgement judgeCrash(const VerdictFacts& facts) {
  if (facts.by_person && facts.yielding) return {Verdict::kStruck, facts.contact + ", which walked into it"};
  if (facts.unseen_glass) return {Verdict::kUnseen, facts.contact + ", glass that never returned a beam"};
  if (!facts.room_to_take_off)
    return {Verdict::kForced, facts.contact + ": the hull does not fit above the place of the take-off"};
  if (facts.contact_margin < 1.0 && facts.landing_margin >= kLowMargin)
    return {Verdict::kForced,
            fmt::format("{}: the thrust fell to {:.2f} times the weight, from {:.2f} when a landing was still possible",
                        facts.contact, facts.contact_margin, facts.landing_margin)};
  return {Verdict::kCrashed, facts.contact};
}

/// Why the flight had to end, by the truth; nullopt without such a reason.
std::optional<std::string> confirmedReason(const VerdictFacts& facts) {
  if (!facts.order.empty()) return facts.order;
  if (!facts.faulty_sensor.empty()) return fmt::format("{} failed", facts.faulty_sensor);
  if (facts.thrust_margin < kLowMargin)
    return fmt::format("the thrust was at most {:.2f} times the weight", facts.thrust_margin);
  const double reserve = std::max(kReserveShare, facts.least_charge);
  if (facts.charge - facts.home_share.value_or(0.0) <= reserve)
    return fmt::format("{:.0f} % of the battery was left, {:.0f} % to fly home and {:.0f} % to keep",
                       100 * facts.charge, 100 * facts.home_share.value_or(0.0), 100 * reserve);
  if (!facts.goal_reachable) return "no path leads to the goal";
  if (facts.position_error_m > kLostPosition_m)
    return fmt::format("the estimated position was {:.2f} m off", facts.position_error_m);
  if (!facts.position_seen) return "the laser saw too little to fix the position";
  if (!facts.floor_seen) return "the floor of the take-off was not below";
  return std::nullopt;
}

std::string unconfirmed(const VerdictFacts& facts) {
  return fmt::format("thrust {:.2f} times the weight, {:.0f} % of the battery left, position {:.2f} m off",
                     facts.thrust_margin, 100 * facts.charge, facts.position_error_m);
}

}  // namespace

const char* toString(Verdict verdict) {
  switch (verdict) {
    case Verdict::kDone:
      return "done";
    case Verdict::kHome:
      return "home";
    case Verdict::kLanded:
      return "landed";
    case Verdict::kRefused:
      return "refused";
    case Verdict::kForced:
      return "forced";
    case Verdict::kStruck:
      return "struck";
    case Verdict::kUnseen:
      return "unseen";
    case Verdict::kNeedless:
      return "needless";
    case Verdict::kCrashed:
      return "crashed";
    case Verdict::kOutside:
      return "outside";
    case Verdict::kUnfinished:
      return "unfinished";
  }
  return "unfinished";
}

bool acceptable(Verdict verdict) { return verdict <= Verdict::kUnseen; }

Judgement judge(const VerdictFacts& facts) {
  if (facts.crashed) return judgeCrash(facts);
  if (facts.mission_done) return {Verdict::kDone, "the mission was done"};
  if (facts.in_the_air) return {Verdict::kUnfinished, "it was still in the air at the end"};
  if (facts.flew && !facts.inside) return {Verdict::kOutside, "it landed where nothing encloses it"};
  const std::optional<std::string> reason = confirmedReason(facts);
  if (!reason) return {Verdict::kNeedless, (facts.flew ? "landed with " : "never took off with ") + unconfirmed(facts)};
  if (!facts.flew) return {Verdict::kRefused, *reason};
  return {facts.at_home ? Verdict::kHome : Verdict::kLanded, *reason};
}

}  // namespace swiftlet::evaluation
