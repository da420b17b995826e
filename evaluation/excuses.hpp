// What the judge excuses: the contacts that no flying could have prevented, and what may end a flight before its
// mission is done. One row each. Nothing else excuses.
//
// No failed sensor excuses a contact. Where one is silent or wrong, the others still measure, and the autopilot holds
// the attitude: the vehicle can come down on its feet, as the flights of trials/faults do.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace swiftlet::evaluation {

struct ContactFacts;
struct VerdictFacts;

template <typename Facts>
struct Excuse {
  const char* why;  ///< The rule and its reason, in a sentence.
  /// What the truth says, with figures; nullopt: the row does not apply.
  std::optional<std::string> (*applies)(const Facts&);
};

/// Of contacts; a flight that ends in one of these was forced.
std::span<const Excuse<ContactFacts>> contactExcuses();
/// Of landings and refused take-offs, which are needless without one.
std::span<const Excuse<VerdictFacts>> endingExcuses();

/// What the first row that applies says.
std::optional<std::string> excuse(const ContactFacts& facts);
std::optional<std::string> excuse(const VerdictFacts& facts);

}  // namespace swiftlet::evaluation
