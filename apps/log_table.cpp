#include "apps/log_table.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "apps/markdown_page.hpp"
#include "apps/output_file.hpp"
#include "common/table.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/required.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

constexpr PageMarks kLogMarks{"<!-- written by `swiftlet evaluate logs --out` -->", "<!-- end of what is written -->",
                              "--out"};

std::string errorText(const std::optional<double>& error_m) { return error_m ? fmt::format("{:.4f}", *error_m) : ""; }

std::string wordFor(MapVerdict verdict) {
  if (verdict == MapVerdict::kByEye) return "by eye";
  return verdict == MapVerdict::kRight ? "right" : "**wrong**";
}

std::vector<common::TableCell> rowOf(const LogRun& run, const LogOutcome& outcome) {
  return {{run.log.name},
          {run.part()},
          {run.backwards ? "back" : "on"},
          {run.wheels ? "yes" : "no"},
          {errorText(outcome.relations_mean_m)},
          {errorText(outcome.relations_max_m)},
          {errorText(outcome.ate_rms_m)},
          {fmt::format("{:.0f}", outcome.path_m)},
          {wordFor(outcome.verdict)},
          {outcome.trust.trusted ? "yes" : "**no**"},
          {fmt::format("{:.4f}", outcome.violation)},
          {fmt::format("{}", outcome.contradictions)},
          {fmt::format("{}", outcome.track.breaks)},
          {fmt::format("{:.0f}", outcome.processor_s)},
          {outcome.trust.trusted ? "" : outcome.trust.reason}};
}

std::ptrdiff_t countOf(const std::vector<LogOutcome>& outcomes, MapVerdict verdict, bool trusted) {
  return std::count_if(outcomes.begin(), outcomes.end(), [&](const LogOutcome& outcome) {
    return outcome.verdict == verdict && outcome.trust.trusted == trusted;
  });
}

/// How many maps of each log, in the order of the runs, are right or wrong, and trusted or not.
std::string confusionTable(const std::vector<LogRun>& runs, const std::vector<LogOutcome>& outcomes) {
  common::Table table{
      "", {"log", "right, trusted", "right, doubted", "wrong, trusted", "wrong, doubted", "by eye"}, {}};
  for (std::size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
    while (end < runs.size() && runs[end].log.name == runs[begin].log.name) ++end;
    const std::vector<LogOutcome> some(outcomes.begin() + static_cast<std::ptrdiff_t>(begin),
                                       outcomes.begin() + static_cast<std::ptrdiff_t>(end));
    const auto cell = [&](MapVerdict verdict, bool trusted) {
      return common::TableCell{fmt::format("{}", countOf(some, verdict, trusted))};
    };
    table.rows.push_back(
        {{runs[begin].log.name},
         cell(MapVerdict::kRight, true),
         cell(MapVerdict::kRight, false),
         cell(MapVerdict::kWrong, true),
         cell(MapVerdict::kWrong, false),
         {fmt::format("{}", countOf(some, MapVerdict::kByEye, true) + countOf(some, MapVerdict::kByEye, false))}});
  }
  return markdownOf(table);
}

std::string countedAs(const std::vector<LogOutcome>& outcomes) {
  const auto count = [&](MapVerdict verdict, bool trusted) { return countOf(outcomes, verdict, trusted); };
  double processor_s = 0.0;
  for (const LogOutcome& outcome : outcomes) processor_s += outcome.processor_s;
  const auto right_doubted = count(MapVerdict::kRight, false), wrong_trusted = count(MapVerdict::kWrong, true);
  return fmt::format(
      "{} maps in {:.0f} s of processor time: {} right, {} wrong, {} by eye. Wrong and trusted: {}. Right and doubted: "
      "{}.\n",
      outcomes.size(), processor_s, right_doubted + count(MapVerdict::kRight, true),
      wrong_trusted + count(MapVerdict::kWrong, false),
      count(MapVerdict::kByEye, true) + count(MapVerdict::kByEye, false), wrong_trusted, right_doubted);
}

bool isThere(const fs::path& page) {
  std::error_code failure;
  return fs::exists(page, failure);
}

}  // namespace

std::string logTable(const std::vector<LogRun>& runs, const std::vector<LogOutcome>& outcomes) {
  common::Table table{"",
                      {"log", "part", "way", "wheels", "mean m", "greatest m", "ATE RMS m", "path m", "map", "trusted",
                       "violation", "contradictions", "lost", "s", "doubted because"},
                      {}};
  for (std::size_t i = 0; i < runs.size(); ++i) table.rows.push_back(rowOf(runs[i], outcomes[i]));
  return markdownOf(table) + "\n" + confusionTable(runs, outcomes) + "\n" + countedAs(outcomes);
}

void checkLogPage(const fs::path& page) {
  if (isThere(page))
    checkPage(page, kLogMarks);
  else
    requireWritable(page, std::string(kLogMarks.option));
}

void writeLogPage(const fs::path& page, const std::string& table) {
  if (!isThere(page))
    required(interfaces::writeAtomically(page, fmt::format("{}\n{}\n", kLogMarks.begin, kLogMarks.end)));
  writeBetween(page, kLogMarks, "\n" + table + "\n");
}

}  // namespace swiftlet::apps
