#include "apps/dry_run.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command_line.hpp"
#include "apps/show.hpp"
#include "behaviors/mission_check.hpp"
#include "behaviors/tree/dry_run.hpp"
#include "common/error.hpp"
#include "common/printable.hpp"
#include "common/read_bytes.hpp"

namespace swiftlet::apps {
namespace {

double secondsOf(const tree::DryRunTick& tick) { return 1e-9 * static_cast<double>(tick.now_ns); }

/// Shows the text in one line, whatever the names in it contain.
void showLine(const std::string& line) { show(common::printable(line) + "\n"); }

/// The answer of the last tick.
tree::Status printTicks(tree::DryRun& run) {
  for (const std::string& leaf : run.unscripted()) showLine("not in the script: " + leaf);
  tree::Status answer = tree::Status::kIdle;
  int count = 0;
  while (const auto tick = run.tick()) {
    answer = tick->answer;
    showLine(fmt::format("tick {}, {:.2f} s: {}", ++count, secondsOf(*tick), toString(answer)));
    for (const std::string& event : tick->events) showLine("  " + event);
  }
  const bool ended = answer == tree::Status::kSuccess || answer == tree::Status::kFailure;
  showLine(fmt::format("{} {} after {} ticks", ended ? "ended with" : "still", toString(answer), count));
  return answer;
}

tree::Status printJson(tree::DryRun& run) {
  auto ticks = nlohmann::json::array();
  tree::Status answer = tree::Status::kIdle;
  while (const auto tick = run.tick()) {
    answer = tick->answer;
    ticks.push_back({{"time_s", secondsOf(*tick)}, {"answer", toString(answer)}, {"events", tick->events}});
  }
  const nlohmann::json all = {{"unscripted", run.unscripted()}, {"ticks", std::move(ticks)}};
  showJson(all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  return answer;
}

}  // namespace

int showDryRun(const DryRunOptions& options, const tree::Registry& types) {
  tree::DryRun run(options.mission, types, tree::readOutcomeScript(common::readText(options.script), options.script),
                   options.mock_leaves, options.parsing);
  if (!run.problems().empty()) throw common::InputError(behaviors::toCommon(run.problems()));
  const tree::Status answer = options.json ? printJson(run) : printTicks(run);
  return answer == tree::Status::kSuccess ? kDone : kFailed;
}

}  // namespace swiftlet::apps
