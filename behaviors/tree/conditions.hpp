// Scripted conditions of a node, as attributes in the file:
//
//   _failureIf _successIf _skipIf   asked in this order when the node would start: it then answers so without starting
//   _while                          asked at each tick: while it is not true, the node is halted and SKIPPED
//   _onSuccess _onFailure           run when it ended so
//   _post                           run when it ended, after those two
//   _onHalted                       run when it was halted, once everything below is released
//
// Conditions that are asked assign nothing, so asking has no effect. A script that cannot be evaluated makes the
// node fail with the reason.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "behaviors/tree/script/script.hpp"
#include "behaviors/tree/status.hpp"

namespace swiftlet::tree {

enum class ConditionKind : unsigned char {
  kFailureIf,
  kSuccessIf,
  kSkipIf,
  kWhile,
  kOnSuccess,
  kOnFailure,
  kOnHalted,
  kPost,
};
inline constexpr std::size_t kConditionKinds = 8;

/// The attribute: "_failureIf".
std::string_view attributeOf(ConditionKind kind);
/// As a port, for messages about the entries that it reads. Static.
const PortManifest& portOf(ConditionKind kind);
/// nullopt if the attribute is no condition.
std::optional<ConditionKind> conditionOf(std::string_view attribute);

/// What the conditions say before a node starts: the status that it has without starting, if there is one.
struct StartDecision {
  bool failed = false;  ///< A script cannot be evaluated; Conditions::problem says why.
  std::optional<Status> status;
};

struct Conditions {
  std::array<Script*, kConditionKinds> scripts{};  ///< Null where the file gives none.
  /// How the node ends after its release, because _while is no longer true.
  std::optional<Status> leaving;

  bool has(ConditionKind kind) const { return scripts[static_cast<std::size_t>(kind)] != nullptr; }
  StartDecision atStart();
  /// _while of a node that is under way; nullopt if it cannot be evaluated.
  std::optional<bool> goesOn();
  /// Runs the scripts for the end of the node, if `status` is one. False if one cannot be evaluated.
  bool afterwards(Status status);
  /// Runs the script for the halt of the node. False if it cannot be evaluated.
  bool afterHalt();
  /// "_skipIf: the entry {x} is not set".
  const std::string& problem() const { return problem_; }

 private:
  std::optional<bool> ask(ConditionKind kind);
  bool run(ConditionKind kind);
  std::string problem_;
};

}  // namespace swiftlet::tree
