#include "apps/dry_run.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/show.hpp"
#include "behaviors/mission_check.hpp"
#include "behaviors/registry.hpp"
#include "behaviors/tree/dry_run.hpp"
#include "common/data_paths.hpp"
#include "common/read_bytes.hpp"

namespace swiftlet::apps {
namespace {

double secondsOf(const tree::DryRunTick& tick) { return 1e-9 * static_cast<double>(tick.now_ns); }

void printTicks(const tree::DryRun& run) {
  for (const std::string& leaf : run.unscripted) show(fmt::format("not in the script: {}\n", leaf));
  for (std::size_t i = 0; i < run.ticks.size(); ++i) {
    const tree::DryRunTick& tick = run.ticks[i];
    show(fmt::format("tick {}, {:.2f} s: {}\n", i + 1, secondsOf(tick), toString(tick.answer)));
    for (const std::string& event : tick.events) show(fmt::format("  {}\n", event));
  }
  const bool ended =
      tree::Status::kSuccess == run.ticks.back().answer || tree::Status::kFailure == run.ticks.back().answer;
  show(fmt::format("{} {} after {} ticks\n", ended ? "ended with" : "still", toString(run.ticks.back().answer),
                   run.ticks.size()));
}

std::string ticksJson(const tree::DryRun& run) {
  auto ticks = nlohmann::json::array();
  for (const tree::DryRunTick& tick : run.ticks)
    ticks.push_back({{"time_s", secondsOf(tick)}, {"answer", toString(tick.answer)}, {"events", tick.events}});
  const nlohmann::json all = {{"unscripted", run.unscripted}, {"ticks", ticks}};
  return all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

void showDryRun(const DryRunOptions& options) {
  const tree::OutcomeScript script = tree::readOutcomeScript(common::readBytes(options.script), options.script);
  const tree::DryRun run = tree::dryRun(common::findData(options.mission).string(), behaviors::missionRegistry(),
                                        script, options.mock_leaves);
  if (!run.problems.empty()) throw common::InputError(behaviors::toCommon(run.problems));
  if (options.json)
    showJson(ticksJson(run));
  else
    printTicks(run);
}

}  // namespace swiftlet::apps
