// swiftlet check: validates missions without flying.
#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/mission_limits.hpp"
#include "apps/show.hpp"
#include "behaviors/mission_check.hpp"
#include "common/data_paths.hpp"

namespace swiftlet::apps {
namespace {

struct CheckOptions {
  std::vector<std::string> missions;
  std::string system = "swiftlet";
  bool mock_leaves = false;
  bool json = false;
};

/// With --mock-leaves, whose nodes they are too; a file that cannot be found is a problem.
behaviors::MockedCheck checkOne(const std::string& mission, const CheckOptions& options, const System& system) {
  if (!options.mock_leaves) return {missionProblems(mission, system), {}};
  try {
    return behaviors::checkMissionWithMocks(common::findData(mission).string(), missionLimits(system, true));
  } catch (const common::InputError& missing) {
    return {missing.problems(), {}};
  }
}

int check(const CheckOptions& options) {
  const System system = loadSystem(options.system);
  auto report = nlohmann::json::array();
  auto nodes = nlohmann::json::object();
  std::size_t count = 0;
  for (const std::string& mission : options.missions) {
    const behaviors::MockedCheck checked = checkOne(mission, options, system);
    for (const std::string& line : checked.whose) {
      nodes[mission].push_back(line);
      if (!options.json) show(fmt::format("{}: {}\n", mission, line));
    }
    for (const common::Problem& problem : checked.problems) {
      ++count;
      report.push_back({{"file", problem.location.file},
                        {"line", problem.location.line},
                        {"column", problem.location.column},
                        {"element", problem.element},
                        {"message", problem.message},
                        {"hint", problem.hint}});
      if (!options.json) showError(toString(problem) + "\n");
    }
  }
  if (options.json) {
    nlohmann::json all = {{"problems", report}};
    if (options.mock_leaves) all["nodes"] = nodes;
    showJson(all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  } else if (count == 0) {
    fmt::print("{} mission{} sound\n", options.missions.size(), options.missions.size() == 1 ? " is" : "s are");
  }
  return count == 0 ? kDone : kBadInput;
}

}  // namespace

void addCheck(Command& program) {
  auto options = std::make_shared<CheckOptions>();
  Command command = program.command("check", "Validate missions without flying; every error with its place.");
  command.arguments("missions", options->missions, "Mission files.");
  command.option("--system", options->system, "The profile they are to be flown with.");
  command.flag(
      "--mock-leaves", options->mock_leaves,
      "Let nodes that Swiftlet does not have be mocks, and say whose each node is; such a mission cannot be flown.");
  command.flag("--json", options->json, "Print the problems as JSON.");
  command.footer("Example: swiftlet check missions/*.xml");
  command.runs([options] { return check(*options); });
}

}  // namespace swiftlet::apps
