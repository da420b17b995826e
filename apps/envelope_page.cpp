#include "apps/envelope_page.hpp"

#include <fmt/format.h>

#include "flight/build_version.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/required.hpp"
#include "interfaces/report/report.hpp"
#include "rendering/envelope_svg.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using evaluation::EnvelopeEntry;
using evaluation::EnvelopeResults;
using evaluation::EnvelopeStep;

/// Without a nature's range there is no multiple of it; then the end of the axis is that of the range that was flown.
double positionOf(const EnvelopeEntry& entry, double value) {
  return entry.harshMultiple(value).value_or(rendering::kEnvelopeAxisEnd * entry.finding.share(value));
}

rendering::EnvelopeBar barOf(const EnvelopeEntry& entry) {
  const evaluation::EnvelopeFinding& finding = entry.finding;
  const auto shown = [&](double value) { return evaluation::shownValue(finding.quantity.key, value); };
  const double acceptable = finding.acceptableTo().value_or(finding.from);
  const EnvelopeStep* failing = finding.firstFailing();
  rendering::EnvelopeBar bar;
  bar.name = finding.quantity.name;
  bar.outer = entry.worstOf(entry.harsh).has_value();
  bar.acceptable = positionOf(entry, acceptable);
  bar.acceptable_text = fmt::format("acceptable from {} to {}", shown(finding.from), shown(acceptable));
  if (const auto real = entry.worstOf(entry.real)) {
    bar.inner = positionOf(entry, *real);
    bar.inner_text = shown(*real);
  }
  if (failing == nullptr) {
    bar.text = fmt::format("{} {}", finding.complete ? "no failure up to" : "not flown beyond", shown(acceptable));
  } else {
    bar.fails = positionOf(entry, failing->value);
    bar.text = fmt::format("{}: {}", shown(failing->value), failing->flights.back().verdict);
  }
  return bar;
}

std::string conditionsOf(const EnvelopeResults& results) {
  return fmt::format(
      "Trial `{}`, system `{}`, base `{}`: {} flights at each value (seeds {} to {}), {} flights in all, version {}.",
      results.trial, results.system, results.config.base, results.config.seeds, results.first_seed,
      results.first_seed + results.config.seeds - 1, results.flights(), results.version);
}

std::string blockOf(const EnvelopeResults& results, const std::string& picture) {
  std::string block = fmt::format("\n{}\n\n![{}]({})\n\n", conditionsOf(results), "What fails first", picture);
  block += markdownOf(evaluation::envelopeTable(results));
  const common::Table ragged = evaluation::raggedTable(results);
  if (!ragged.rows.empty()) block += "\n" + ragged.title + ":\n\n" + markdownOf(ragged);
  return block + "\n";
}

}  // namespace

std::string envelopePicture(const EnvelopeResults& results) {
  rendering::EnvelopePicture picture{fmt::format("What fails first: {}", results.trial), "real", "harsh", {}};
  for (const EnvelopeEntry* entry : results.byReserve())
    if (entry->finding.steps.size() > 1) picture.bars.push_back(barOf(*entry));
  return rendering::envelopeSvg(picture);
}

std::string envelopeReport(const EnvelopeResults& results, const std::string& started) {
  interfaces::TrialReport report;
  report.version = flight::buildVersion();
  report.title = fmt::format("Envelope of {}", results.trial);
  report.subtitle = started;
  report.plots_svg.push_back(envelopePicture(results));
  report.tables = {evaluation::envelopeTable(results), evaluation::raggedTable(results),
                   evaluation::failedFlightTable(results)};
  return interfaces::trialReport(report);
}

void writePage(const fs::path& page, const EnvelopeResults& results) {
  const fs::path picture = fs::path("images") / page.stem().concat(".svg");
  std::error_code failure;  // The write below reports it.
  fs::create_directories(page.parent_path() / "images", failure);
  required(interfaces::writeAtomically(page.parent_path() / picture, envelopePicture(results)));
  writeBetween(page, kEnvelopeMarks, blockOf(results, picture.string()));
}

}  // namespace swiftlet::apps
