#include "behaviors/tree/conditions.hpp"

#include <algorithm>

namespace swiftlet::tree {
namespace {

/// In the order of ConditionKind.
constexpr std::array<std::string_view, kConditionKinds> kAttributes = {
    "_failureIf", "_successIf", "_skipIf", "_while", "_onSuccess", "_onFailure", "_onHalted", "_post"};

}  // namespace

std::string_view attributeOf(ConditionKind kind) { return kAttributes[static_cast<std::size_t>(kind)]; }

const PortManifest& portOf(ConditionKind kind) {
  static const std::array<PortManifest, kConditionKinds> kPorts = [] {
    std::array<PortManifest, kConditionKinds> ports;
    for (std::size_t i = 0; i < ports.size(); ++i)
      ports[i] = {.name = std::string(kAttributes[i]),
                  .type = PortType::kScript,
                  .asked = static_cast<ConditionKind>(i) <= ConditionKind::kWhile};
    return ports;
  }();
  return kPorts[static_cast<std::size_t>(kind)];
}

std::optional<ConditionKind> conditionOf(std::string_view attribute) {
  const auto* known = std::find(kAttributes.begin(), kAttributes.end(), attribute);
  if (known == kAttributes.end()) return std::nullopt;
  return static_cast<ConditionKind>(known - kAttributes.begin());
}

StartDecision Conditions::atStart() {
  struct Question {
    ConditionKind kind;
    bool decides;  ///< The answer that decides.
    Status status;
  };
  constexpr std::array kQuestions = {Question{ConditionKind::kFailureIf, true, Status::kFailure},
                                     Question{ConditionKind::kSuccessIf, true, Status::kSuccess},
                                     Question{ConditionKind::kSkipIf, true, Status::kSkipped},
                                     Question{ConditionKind::kWhile, false, Status::kSkipped}};
  for (const Question& question : kQuestions) {
    if (!has(question.kind)) continue;
    const auto answer = ask(question.kind);
    if (!answer) return {true, Status::kFailure};
    if (*answer == question.decides) return {false, question.status};
  }
  return {};
}

std::optional<bool> Conditions::goesOn() { return has(ConditionKind::kWhile) ? ask(ConditionKind::kWhile) : true; }

bool Conditions::afterwards(Status status) {
  if (status != Status::kSuccess && status != Status::kFailure) return true;
  const bool ended = run(status == Status::kSuccess ? ConditionKind::kOnSuccess : ConditionKind::kOnFailure);
  return run(ConditionKind::kPost) && ended;
}

bool Conditions::afterHalt() { return run(ConditionKind::kOnHalted); }

std::optional<bool> Conditions::ask(ConditionKind kind) {
  Script& script = *scripts[static_cast<std::size_t>(kind)];
  const auto answer = script.holds();
  if (!answer) problem_ = std::string(attributeOf(kind)) + ": " + script.problem();
  return answer;
}

bool Conditions::run(ConditionKind kind) {
  Script* script = scripts[static_cast<std::size_t>(kind)];
  if (script == nullptr || script->run()) return true;
  problem_ = std::string(attributeOf(kind)) + ": " + script->problem();
  return false;
}

}  // namespace swiftlet::tree
