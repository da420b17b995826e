// swiftlet failsafe: what the vehicle does about what is found to be wrong.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/show.hpp"
#include "behaviors/tree/problem.hpp"
#include "control/failsafe.hpp"

namespace swiftlet::apps {
namespace {

using control::Failsafe;
using control::FindingKind;
using control::FlightPhase;

struct FailsafeOptions {
  std::vector<std::string> findings;
  std::string phase;  ///< Empty: flying for findings, all for the table.
  bool markdown = false;
  bool json = false;
};

/// As a word of the command line: "surroundings-unseen".
std::string wordOf(std::string_view name) {
  std::string word(name);
  std::ranges::replace(word, ' ', '-');
  return word;
}

std::vector<FindingKind> allFindings() {
  std::vector<FindingKind> all;
  for (const Failsafe& row : control::failsafes())
    if (std::ranges::find(all, row.finding) == all.end()) all.push_back(row.finding);
  return all;
}

std::string phasesOf(const Failsafe& row) {
  std::string phases;
  for (const FlightPhase phase : control::kFlightPhases)
    if (row.phases[static_cast<std::size_t>(phase)])
      phases += fmt::format("{}{}", phases.empty() ? "" : ", ", control::toString(phase));
  return phases;
}

std::string responseOf(const Failsafe& row) {
  std::string text(control::toString(row.response));
  if (row.then != control::Response::kNone) text += fmt::format(", then {}", control::toString(row.then));
  return text;
}

/// The text of docs/failsafes.md.
std::string page() {
  std::string text =
      "# Fail-safes\n\n"
      "Printed by `swiftlet failsafe --markdown`. What is found to be wrong, and what the vehicle does about it. The "
      "rows stand by\nrank: of several findings the highest row is active, and only that. "
      "`swiftlet failsafe --phase flying surroundings-unseen\ncharge-for-home` says which of these that is.\n\n"
      "| finding | when | the vehicle does | ends | the operator can |\n| --- | --- | --- | --- | --- |\n";
  for (const Failsafe& row : control::failsafes())
    text += fmt::format("| {} | {} | {} | {} | {} |\n", control::toString(row.finding), phasesOf(row), responseOf(row),
                        control::toString(row.ends), control::operatorCan(row));
  text += "\n| finding | it is found when |\n| --- | --- |\n";
  for (const FindingKind finding : allFindings())
    text += fmt::format("| {} | {} |\n", control::toString(finding), control::meaning(finding));
  return text;
}

/// The text of web/console/failsafes.json, which the page shows.
std::string json() {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Failsafe& row : control::failsafes()) {
    nlohmann::ordered_json phases = nlohmann::ordered_json::array();
    for (const FlightPhase phase : control::kFlightPhases)
      if (row.phases[static_cast<std::size_t>(phase)]) phases.push_back(control::toString(phase));
    rows.push_back({{"finding", control::toString(row.finding)},
                    {"phases", phases},
                    {"response", responseOf(row)},
                    {"ends", control::toString(row.ends)},
                    {"operator_can", control::operatorCan(row)}});
  }
  return rows.dump(1) + "\n";
}

/// Of one phase, or of all.
std::string table(const std::optional<FlightPhase>& phase) {
  std::string text = fmt::format("{:<21} {:<25} {:<45} {}\n", "finding", "ends", "the vehicle does", "when");
  for (const Failsafe& row : control::failsafes())
    if (!phase || row.phases[static_cast<std::size_t>(*phase)])
      text += fmt::format("{:<21} {:<25} {:<45} {}\n", wordOf(control::toString(row.finding)),
                          control::toString(row.ends), responseOf(row), phasesOf(row));
  return text;
}

/// What is active when all of these are found, and what each would cause alone; the table without any.
int printActive(const FailsafeOptions& options) {
  std::vector<std::string> known_findings, known_phases;
  for (const FindingKind finding : allFindings()) known_findings.push_back(wordOf(control::toString(finding)));
  for (const FlightPhase phase : control::kFlightPhases) known_phases.push_back(wordOf(control::toString(phase)));
  std::string problems;
  const auto placeOf = [&](const std::string& word, const std::vector<std::string>& known, const char* kind) {
    const auto found = std::ranges::find(known, wordOf(word));
    const std::string similar = tree::didYouMean(word, known);
    if (found == known.end())
      problems += toString(tree::Problem{{},
                                         "failsafe",
                                         tree::Message("failsafe.unknown-word", "unknown {} `{}`", kind, word),
                                         similar.empty() ? "`swiftlet failsafe` lists all" : similar}) +
                  "\n";
    return static_cast<std::size_t>(found == known.end() ? 0 : found - known.begin());
  };
  const std::string word = options.phase.empty() ? "flying" : options.phase;
  const FlightPhase phase = control::kFlightPhases[placeOf(word, known_phases, "phase")];
  std::vector<FindingKind> findings;
  for (const std::string& finding : options.findings)
    findings.push_back(allFindings()[placeOf(finding, known_findings, "finding")]);
  if (!problems.empty()) {
    showError(problems);
    return kBadInput;
  }
  if (findings.empty()) {
    show(table(options.phase.empty() ? std::nullopt : std::optional(phase)));
    return kDone;
  }
  const Failsafe* active = control::activeFailsafe(findings, phase);
  std::string text =
      fmt::format("{}: {}\n", control::toString(phase), active == nullptr ? "nothing follows" : responseOf(*active));
  if (active != nullptr)
    text += fmt::format("  because of: {}\n  ends: {}\n  the operator can: {}\n", control::toString(active->finding),
                        control::toString(active->ends), control::operatorCan(*active));
  for (const FindingKind finding : findings) {
    const Failsafe* row = control::failsafeFor(finding, phase);
    if (row == active) continue;
    text += fmt::format("  {} alone: {}\n", control::toString(finding),
                        row == nullptr ? "nothing in this phase" : responseOf(*row));
  }
  show(text);
  return kDone;
}

int printFailsafes(const FailsafeOptions& options) {
  const int forms = int{options.markdown} + int{options.json};
  if (forms > 1 || (forms == 1 && !options.findings.empty())) {
    showError("failsafe: expected findings, or one of --markdown and --json\n");
    return kBadInput;
  }
  if (forms == 0) return printActive(options);
  show(options.markdown ? page() : json());
  return kDone;
}

}  // namespace

void addFailsafe(Command& program) {
  auto options = std::make_shared<FailsafeOptions>();
  Command command = program.command("failsafe", "Print what the vehicle does about what is found to be wrong.");
  command.optionalArguments("finding", options->findings, "Findings at the same time; the table of all without any.");
  command.option(
      "--phase", options->phase,
      "on-the-ground, taking-off, flying or landing; flying for findings, all for the table when not given.");
  command.flag("--markdown", options->markdown, "The table as a page: docs/failsafes.md.");
  command.flag("--json", options->json, "The table for programs: web/console/failsafes.json.");
  command.footer("Example: swiftlet failsafe --phase flying surroundings-unseen charge-for-home");
  command.runs([options] { return printFailsafes(*options); });
}

}  // namespace swiftlet::apps
