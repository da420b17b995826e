// The tables of the report of an envelope.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "evaluation/envelope_results.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Mark;
using common::Table;
using common::TableCell;

std::string shownOrDash(const std::string& key, const std::optional<double>& value) {
  return value ? shownValue(key, *value) : "-";
}

/// Red if what fails lies within what `real` draws.
Mark markOf(const EnvelopeEntry& entry) {
  const EnvelopeStep* failing = entry.finding.firstFailing();
  const auto real = entry.worstOf(entry.real), harsh = entry.worstOf(entry.harsh);
  if (failing == nullptr) return Mark::kGood;
  const auto within = [&](const std::optional<double>& worst) {
    return worst && entry.finding.share(failing->value) <= entry.finding.share(*worst);
  };
  return within(real) || within(harsh) ? Mark::kBad : Mark::kNone;
}

std::vector<TableCell> rowOf(const EnvelopeEntry& entry) {
  const EnvelopeFinding& finding = entry.finding;
  const std::string& key = finding.quantity.key;
  const EnvelopeStep* failing = finding.firstFailing();
  const auto multiple = failing != nullptr ? entry.harshMultiple(failing->value) : std::nullopt;
  const std::string fails = failing != nullptr ? shownValue(key, failing->value)
                            : finding.complete ? "not up to " + shownValue(key, finding.quantity.to)
                                               : "not flown to its end";
  return {{finding.quantity.name},
          {key},
          {shownValue(key, finding.from)},
          {shownOrDash(key, entry.worstOf(entry.real))},
          {shownOrDash(key, entry.worstOf(entry.harsh))},
          {shownOrDash(key, finding.acceptableTo())},
          {fails, markOf(entry)},
          {multiple ? fmt::format("{:.1f}", *multiple) : "-"},
          {endingText(finding)}};
}

void addFailed(const std::string& name, const std::string& key, const EnvelopeStep& step, Table& table) {
  for (const EnvelopeFlight& flight : step.flights)
    if (!flight.acceptable)
      table.rows.push_back(
          {{name},
           {key.empty() ? "-" : shownValue(key, step.value)},
           {fmt::format("{}", flight.seed), Mark::kNone, flight.folder.empty() ? "" : flight.folder + "/report.html"},
           {flight.verdict, Mark::kBad},
           {flight.ending}});
}

}  // namespace

Table envelopeTable(const EnvelopeResults& results) {
  Table table{"What fails first",
              {"quantity", "key", "base", "worst of real", "worst of harsh", "acceptable to", "fails at",
               "multiple of harsh", "how"},
              {}};
  for (const EnvelopeEntry* entry : results.byReserve())
    if (entry->finding.steps.size() > 1) table.rows.push_back(rowOf(*entry));
  return table;
}

Table failedFlightTable(const EnvelopeResults& results) {
  Table table{"Flights that failed", {"quantity", "value", "seed", "verdict", "how"}, {}};
  addFailed("base", "", results.base, table);
  for (const EnvelopeEntry* entry : results.byReserve())
    for (std::size_t i = 1; i < entry->finding.steps.size(); ++i)
      addFailed(entry->finding.quantity.name, entry->finding.quantity.key, entry->finding.steps[i], table);
  return table;
}

Table raggedTable(const EnvelopeResults& results) {
  Table table{"Acceptable again beyond the first failure", {"quantity", "fails at", "acceptable at"}, {}};
  for (const EnvelopeEntry* entry : results.byReserve()) {
    const std::string& key = entry->finding.quantity.key;
    std::string beyond;
    for (const double value : entry->finding.acceptableBeyond())
      beyond += (beyond.empty() ? "" : ", ") + shownValue(key, value);
    if (!beyond.empty())
      table.rows.push_back(
          {{entry->finding.quantity.name}, {shownValue(key, entry->finding.firstFailing()->value)}, {beyond}});
  }
  return table;
}

}  // namespace swiftlet::evaluation
