// swiftlet check: validates missions without flying.
#include <map>
#include <memory>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/dry_run.hpp"
#include "apps/mission_limits.hpp"
#include "apps/output_file.hpp"
#include "apps/required.hpp"
#include "apps/show.hpp"
#include "behaviors/mission_check.hpp"
#include "behaviors/registry.hpp"
#include "behaviors/tree/drawing.hpp"
#include "behaviors/tree/mocks.hpp"
#include "behaviors/tree/parser.hpp"
#include "common/data_paths.hpp"
#include "common/printable.hpp"
#include "interfaces/files/atomic_file.hpp"

namespace swiftlet::apps {
namespace {

struct CheckOptions {
  std::vector<std::string> missions;
  std::string system = "swiftlet";
  std::string dry_run;  ///< The script; empty: none.
  std::string draw;     ///< The SVG; empty: none.
  bool mock_leaves = false;
  bool json = false;
};

/// A file that cannot be found is a problem.
behaviors::MissionVerdict judge(const std::string& mission, const CheckOptions& options, const System& system) {
  try {
    const std::string file = common::findData(mission).string();
    const behaviors::MissionLimits limits = missionLimits(system, true);
    return options.mock_leaves ? behaviors::judgeMissionWithMocks(file, limits) : behaviors::judgeMission(file, limits);
  } catch (const common::InputError& missing) {
    behaviors::MissionVerdict verdict;
    for (const common::Problem& problem : missing.problems())
      verdict.problems.push_back({{problem.location.file, 0, 0}, problem.element, problem.message, problem.hint, {}});
    return verdict;
  }
}

/// "m.xml:4:7: warning: Land: is never reached ... [M/Sequence/Land]"; one line, whatever the names in it hold.
std::string lineOf(tree::Problem problem, bool warning) {
  if (warning) problem.element = "warning" + (problem.element.empty() ? "" : ": " + problem.element);
  return common::printable(toString(problem) + (problem.path.empty() ? "" : " [" + problem.path + "]")) + "\n";
}

nlohmann::json jsonOf(const std::vector<tree::Problem>& problems) {
  auto list = nlohmann::json::array();
  for (const tree::Problem& problem : problems)
    list.push_back({{"file", problem.location.file},
                    {"line", problem.location.line},
                    {"column", problem.location.column},
                    {"element", problem.element},
                    {"message", problem.message},
                    {"hint", problem.hint},
                    {"path", problem.path}});
  return list;
}

struct CheckReport {
  std::vector<tree::Problem> problems;
  std::vector<tree::Problem> warnings;
  std::map<std::string, std::vector<std::string>> nodes;  ///< By mission: whose they are.
};

CheckReport reportOn(const CheckOptions& options) {
  const System system = loadSystem(options.system);
  CheckReport report;
  for (const common::Problem& problem : problemsOfSensors(system))
    report.problems.push_back({{problem.location.file, problem.location.line, problem.location.column},
                               problem.element,
                               problem.message,
                               problem.hint,
                               {}});
  for (const std::string& mission : options.missions) {
    behaviors::MissionVerdict verdict = judge(mission, options, system);
    report.problems.insert(report.problems.end(), verdict.problems.begin(), verdict.problems.end());
    report.warnings.insert(report.warnings.end(), verdict.warnings.begin(), verdict.warnings.end());
    if (!verdict.whose.empty()) report.nodes[mission] = std::move(verdict.whose);
  }
  return report;
}

void print(const CheckReport& report, std::size_t missions) {
  for (const auto& [mission, lines] : report.nodes)
    for (const std::string& line : lines) show(fmt::format("{}: {}\n", mission, line));
  for (const tree::Problem& problem : report.problems) showError(lineOf(problem, false));
  for (const tree::Problem& warning : report.warnings) showError(lineOf(warning, true));
  if (!report.problems.empty()) return;
  const std::string warnings = report.warnings.empty() ? ""
                                                       : fmt::format(", with {} warning{}", report.warnings.size(),
                                                                     report.warnings.size() == 1 ? "" : "s");
  fmt::print("{} mission{} sound{}\n", missions, missions == 1 ? " is" : "s are", warnings);
}

void draw(const CheckOptions& options) {
  const std::string file = common::findData(options.missions.front()).string();
  const tree::Registry& ours = behaviors::missionRegistry();
  const tree::MockedRegistry known =
      options.mock_leaves ? tree::withMocks(file, ours) : tree::MockedRegistry{ours, {}, {}};
  const tree::ParseResult parsed = tree::parseFile(file, known.registry, known.options);
  required(interfaces::writeAtomically(options.draw, tree::drawTree(*parsed.tree)));
}

int check(const CheckOptions& options) {
  for (const auto& [option, value] : {std::pair{"--dry-run", options.dry_run}, {"--draw", options.draw}})
    if (!value.empty() && options.missions.size() != 1)
      throw common::InputError(common::Problem{{}, option, "the file is of one mission", "name that one alone"});
  if (!options.draw.empty()) requireWritable(options.draw, "--draw");
  const CheckReport report = reportOn(options);
  if (!options.draw.empty() && report.problems.empty()) draw(options);
  if (!options.dry_run.empty() && report.problems.empty()) {
    if (!options.json) print(report, 1);
    return showDryRun({options.missions.front(), options.dry_run, options.mock_leaves, options.json});
  }
  if (options.json) {
    nlohmann::json all = {{"problems", jsonOf(report.problems)}, {"warnings", jsonOf(report.warnings)}};
    if (options.mock_leaves) all["nodes"] = report.nodes;
    showJson(all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  } else {
    print(report, options.missions.size());
  }
  return report.problems.empty() ? kDone : kBadInput;
}

}  // namespace

void addCheck(Command& program) {
  auto options = std::make_shared<CheckOptions>();
  Command command =
      program.command("check", "Validate missions without flying; every error and every warning with its place.");
  command.arguments("missions", options->missions, "Mission files.");
  command.option("--system", options->system, "The profile they are to be flown with.");
  command.option("--dry-run", options->dry_run,
                 "Also tick the mission, with answers of its leaves from this script, and print what happens: lines as "
                 "`TakeOff: RUNNING x3, SUCCESS`. The exit code is 1 unless the mission ends with SUCCESS.");
  command.option("--draw", options->draw, "Also write a picture of the tree into this file (SVG).");
  command.flag(
      "--mock-leaves", options->mock_leaves,
      "Let nodes that Swiftlet does not have be mocks, and say whose each node is; such a mission cannot be flown.");
  command.flag("--json", options->json, "Print the problems as JSON.");
  command.footer("Example: swiftlet check missions/*.xml --system swiftlet_3d");
  command.runs([options] { return check(*options); });
}

}  // namespace swiftlet::apps
