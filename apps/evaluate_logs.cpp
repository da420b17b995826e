#include "apps/evaluate_logs.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/log_run.hpp"
#include "apps/log_table.hpp"
#include "apps/progress_line.hpp"
#include "apps/shared_logs.hpp"
#include "apps/show.hpp"
#include "common/error.hpp"
#include "flight/system.hpp"
#include "flight/wall_clock.hpp"
#include "simulated_flight/flights_in_parallel.hpp"

namespace swiftlet::apps {
namespace {

struct LogsOptions {
  std::string out, part = "all", datasets, system = "laser_log";
  std::vector<std::string> only;
  bool variations = false;
  int jobs = 1;
};

std::vector<SharedLog> chosen(const LogsOptions& options) {
  std::vector<SharedLog> logs = readSharedLogs(options.datasets);
  for (const std::string& name : options.only)
    if (std::none_of(logs.begin(), logs.end(), [&](const SharedLog& log) { return log.name == name; })) {
      std::string names;
      for (const SharedLog& log : logs)
        if (names.find(log.name) == std::string::npos) names += (names.empty() ? "" : ", ") + log.name;
      throw common::InputError({}, "--log", common::Message("logs.no-such-log", "there is no log `{}`", name),
                               "there are " + names);
    }
  std::erase_if(logs, [&](const SharedLog& log) {
    const bool named =
        options.only.empty() || std::find(options.only.begin(), options.only.end(), log.name) != options.only.end();
    return !named || (options.part == "short" && !log.short_part);
  });
  return logs;
}

int evaluateLogs(const LogsOptions& options) {
  if (!options.out.empty()) checkLogPage(options.out);
  const std::vector<LogRun> runs = logRuns(chosen(options), options.variations);
  (void)flight::loadSystem(options.system);
  std::vector<LogOutcome> outcomes(runs.size());
  const auto begin = flight::Clock::now();
  ProgressLine line(false);
  std::mutex mutex;
  std::size_t done = 0;
  const std::atomic<bool> stop{false};
  simulated_flight::flyInParallel(static_cast<int>(runs.size()), options.jobs, stop, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    outcomes[at] = mapped(runs[at], options.system);
    const std::scoped_lock lock(mutex);
    ++done;
    line.update(fmt::format("{} of {} maps", done, runs.size()), flight::secondsSince(begin));
  });
  line.close();
  const std::string table = logTable(runs, outcomes);
  show(table);
  if (!options.out.empty()) writeLogPage(options.out, table);
  return kDone;
}

}  // namespace

void addEvaluateLogs(Command& evaluate) {
  auto options = std::make_shared<LogsOptions>();
  Command command = evaluate.command(
      "logs", "Map all recorded logs, forwards and backwards, and print their errors and whether they are trusted.");
  command.option("--out", options->out,
                 "Page (Markdown) to put the table into, the rest of which stays; made if not there.");
  command.choice("--part", options->part, {"all", "short"}, "short: less than a minute, the part that a test maps.");
  command.option("--log", options->only, "Only the logs with this name.");
  command.flag("--variations", options->variations,
               "Map each log in six made-up variations of it instead, to see whether wrong maps are doubted.");
  command.option("--jobs", options->jobs, {1, 64}, "Maps that are made at the same time.");
  command.option("--datasets", options->datasets,
                 "Folder of the data sets; $SWIFTLET_DATASETS or ../shared/datasets when not given.");
  command.option("--system", options->system, "A profile of config/systems, or a file: its odometry and SLAM.");
  command.footer(
      "The logs and their references are listed in config/logs.yaml. The seconds are of the processor.\n"
      "Example: swiftlet evaluate logs --jobs 2 --out docs/logs.md");
  command.runs([options] { return evaluateLogs(*options); });
}

}  // namespace swiftlet::apps
