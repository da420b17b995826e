// What tests ask of problems: their name and place, not their English, which docs/messages.md lists.
#pragma once

#include <cctype>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "common/error.hpp"

namespace swiftlet::common {

inline void PrintTo(const Message& message, std::ostream* to) {
  *to << message.name() << " (" << message.text() << ")";
}
inline void PrintTo(const Problem& problem, std::ostream* to) {
  *to << problem.message.name() << " (" << toString(problem) << ")";
}

}  // namespace swiftlet::common

namespace swiftlet::test_support {

/// "file:line:column: element".
inline std::string placeOf(common::Problem problem) {
  problem.message = {};
  problem.hint.clear();
  return toString(problem);
}

/// Whether a place is this one, of which the test may leave out the folders or the file, the column and the element.
/// What is left out ends with a folder, with the name of the file or with the column: a line is not left out.
inline bool isPlace(const std::string& place, const std::string& wanted) {
  for (std::size_t at = place.find(wanted); at != std::string::npos; at = place.find(wanted, at + 1)) {
    const std::string_view before = std::string_view(place).substr(0, at);
    const std::string_view behind = std::string_view(place).substr(at + wanted.size());
    const bool after_file = before.ends_with(":") && before.size() > 1 && !std::isdigit(before[before.size() - 2]);
    if ((before.empty() || before.ends_with("/") || before.ends_with(": ") || after_file) &&
        (behind.empty() || behind[0] == ':'))
      return true;
  }
  return wanted.empty();
}

MATCHER_P2(IsMessage, name, says, "") {
  return arg.name() == std::string(name) && arg.text().find(std::string(says)) != std::string::npos;
}

/// The message of that name, whose text quotes that.
inline auto MessageIs(const std::string& name, const std::string& says = "") { return IsMessage(name, says); }

/// Where several kinds of problems may be told.
inline constexpr const char* kAnyName = "";

MATCHER_P3(IsProblem, name, place, says, "") {
  return (std::string(name) == kAnyName || arg.message.name() == std::string(name)) && isPlace(placeOf(arg), place) &&
         toString(arg).find(std::string(says)) != std::string::npos;
}

/// The problem of that name at that place. `says` is what its text or hint quotes: `a value` or `a command`.
inline auto ProblemIs(const std::string& name, const std::string& place = "", const std::string& says = "") {
  return IsProblem(name, place, says);
}

/// Among several.
inline auto HasProblem(const std::string& name, const std::string& place = "", const std::string& says = "") {
  return ::testing::Contains(ProblemIs(name, place, says));
}

/// With which a call is refused; none if it is not.
template <typename Call>
std::vector<common::Problem> problemsOf(Call&& call) {
  try {
    std::forward<Call>(call)();
  } catch (const common::InputError& error) {
    return error.problems();
  }
  return {};
}

}  // namespace swiftlet::test_support
