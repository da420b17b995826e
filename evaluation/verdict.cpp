#include "evaluation/verdict.hpp"

#include <fmt/format.h>

#include "evaluation/excuses.hpp"
#include "evaluation/verdict_facts.hpp"

namespace swiftlet::evaluation {
namespace {

Judgement judgeContact(const ContactFacts& contact) {
  if (const auto excused = excuse(contact)) return {Verdict::kForced, contact.what + ": " + *excused};
  if (contact.by_person && contact.yielding) return {Verdict::kStruck, contact.what + ", which walked into it"};
  return {Verdict::kCrashed, contact.what};
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

bool acceptable(Verdict verdict) { return verdict <= Verdict::kForced; }

Judgement judge(const VerdictFacts& facts) {
  if (facts.contact) return judgeContact(*facts.contact);
  if (facts.mission_done) return {Verdict::kDone, "the mission was done"};
  if (facts.in_the_air) return {Verdict::kUnfinished, "it was still in the air at the end"};
  if (!facts.motors_off) return {Verdict::kUnfinished, "its motors were still on at the end"};
  if (facts.flew && !facts.inside) return {Verdict::kOutside, "it landed where nothing encloses it"};
  const std::optional<std::string> reason = excuse(facts);
  if (!reason) return {Verdict::kNeedless, (facts.flew ? "landed with " : "never took off with ") + unconfirmed(facts)};
  if (!facts.flew) return {Verdict::kRefused, *reason};
  return {facts.at_home ? Verdict::kHome : Verdict::kLanded, *reason};
}

}  // namespace swiftlet::evaluation
