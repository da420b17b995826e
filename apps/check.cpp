// swiftlet check: validates missions without flying.
#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/dry_run.hpp"
#include "apps/output_file.hpp"
#include "apps/show.hpp"
#include "behaviors/mission.hpp"
#include "behaviors/mission_check.hpp"
#include "behaviors/tree/documents.hpp"
#include "behaviors/tree/drawing.hpp"
#include "behaviors/tree/mocks.hpp"
#include "behaviors/tree/parser.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "common/topological_map.hpp"
#include "flight/files_of_kind.hpp"
#include "flight/given_map.hpp"
#include "flight/leaf_libraries.hpp"
#include "flight/mission_limits.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/required.hpp"

namespace swiftlet::apps {
namespace {

struct CheckOptions {
  std::vector<std::string> missions;
  std::vector<std::string> leaves;
  std::string system = "swiftlet";
  std::string places;
  std::string dry_run;  ///< The script; empty: none.
  std::string draw;     ///< The SVG; empty: none.
  bool headless = false;
  bool mock_leaves = false;
  bool json = false;
};

/// A mission that was named, and its file, or why it has no file.
struct NamedMission {
  std::string name;
  std::string file = {};
  std::vector<tree::Problem> problems = {};
};

void append(const std::vector<common::Problem>& problems, std::vector<tree::Problem>& all) {
  for (const common::Problem& problem : problems) all.push_back(behaviors::toTree(problem));
}

std::vector<NamedMission> find(const std::vector<std::string>& names) {
  std::vector<NamedMission> missions;
  for (const std::string& name : names) {
    NamedMission& mission = missions.emplace_back(NamedMission{name});
    try {
      mission.file = flight::findMission(name);
    } catch (const common::InputError& missing) {
      append(missing.problems(), mission.problems);
    }
  }
  return missions;
}

/// The trees of files that are named together.
tree::TreeFiles treesOf(const std::vector<NamedMission>& missions) {
  if (missions.size() < 2) return {};
  std::vector<std::string> files;
  for (const NamedMission& mission : missions)
    if (!mission.file.empty()) files.push_back(mission.file);
  return tree::treeFiles(files);
}

/// What is odd about the maps that a mission may load is a warning, a map that cannot be used a problem.
void addMapNotes(const std::string& file, const behaviors::MissionLimits& limits, const behaviors::NodeTypes& types,
                 behaviors::MissionVerdict& verdict) {
  try {
    append(flight::mapNotes(behaviors::Mission::fromFile(file, limits, types).mapFiles(), file), verdict.warnings);
  } catch (const common::InputError& unusable) {
    append(unusable.problems(), verdict.problems);
  }
}

behaviors::MissionVerdict judge(const NamedMission& mission, const CheckOptions& options, const flight::System& system,
                                const behaviors::NodeTypes& types, const tree::TreeFiles& together,
                                const std::shared_ptr<const common::TopologicalMap>& places) {
  if (mission.file.empty()) return {mission.problems, {}, {}};
  behaviors::MissionLimits limits = flight::missionLimits(system, true);
  limits.operator_goes_on = limits.operator_gives_goals = !options.headless;
  limits.places = places;
  if (options.mock_leaves) return behaviors::judgeMissionWithMocks(mission.file, limits, *types, together);
  behaviors::MissionVerdict verdict = behaviors::judgeMission(mission.file, limits, *types, together);
  if (verdict.problems.empty()) addMapNotes(mission.file, limits, types, verdict);
  return verdict;
}

nlohmann::json jsonOf(const std::vector<tree::Problem>& problems) {
  auto list = nlohmann::json::array();
  for (const tree::Problem& problem : problems)
    list.push_back({{"file", problem.location.file},
                    {"line", problem.location.line},
                    {"column", problem.location.column},
                    {"element", problem.element},
                    {"code", problem.message.name()},
                    {"message", problem.message.text()},
                    {"hint", problem.hint},
                    {"path", problem.path}});
  return list;
}

struct CheckReport {
  std::vector<tree::Problem> problems;
  std::vector<tree::Problem> warnings;
  std::map<std::string, std::vector<std::string>> nodes;  ///< By mission: the owners of its nodes.
};

/// A file that several missions use is reported once.
void add(std::vector<tree::Problem>& all, const std::vector<tree::Problem>& found) {
  for (const tree::Problem& problem : found)
    if (std::find(all.begin(), all.end(), problem) == all.end()) all.push_back(problem);
}

CheckReport reportOn(const CheckOptions& options, const std::vector<NamedMission>& missions,
                     const behaviors::NodeTypes& types, const tree::TreeFiles& together,
                     const std::shared_ptr<const common::TopologicalMap>& places) {
  const flight::System system = flight::loadSystem(options.system);
  CheckReport report;
  append(flight::problemsOfSensors(system), report.problems);
  if (options.mock_leaves) add(report.warnings, together.warnings);
  for (const NamedMission& mission : missions) {
    behaviors::MissionVerdict verdict = judge(mission, options, system, types, together, places);
    add(report.problems, verdict.problems);
    add(report.warnings, verdict.warnings);
    if (!verdict.whose.empty()) report.nodes[mission.name] = std::move(verdict.whose);
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

void draw(const CheckOptions& options, const tree::Registry& ours, const std::string& file,
          const tree::ParseOptions& parsing) {
  const tree::MockedRegistry known =
      options.mock_leaves ? tree::withMocks(file, ours, parsing) : tree::MockedRegistry{ours, {}, parsing};
  const tree::ParseResult parsed = tree::parseFile(file, known.registry, known.options);
  required(interfaces::writeAtomically(options.draw, tree::drawTree(*parsed.tree)));
}

/// --dry-run and --draw are of one tree. With mocks that of the first file, which may use the trees of the others.
void requireOneTree(const CheckOptions& options) {
  for (const auto& [option, value] : {std::pair{"--dry-run", options.dry_run}, {"--draw", options.draw}})
    if (!value.empty() && options.missions.size() != 1 && !options.mock_leaves)
      throw common::InputError({}, option, common::Message("check.one-mission", "the file is of one mission"),
                               "name that one alone");
}

int check(const CheckOptions& options) {
  requireOneTree(options);
  if (!options.draw.empty()) requireWritable(options.draw, "--draw");
  const behaviors::NodeTypes types = flight::nodesWith(options.leaves);
  const std::vector<NamedMission> missions = find(options.missions);
  tree::ParseOptions parsing;
  parsing.trees_elsewhere = treesOf(missions);
  std::shared_ptr<const common::TopologicalMap> places;
  if (!options.places.empty()) {
    places = std::make_shared<const common::TopologicalMap>(
        common::readTopologicalMap(common::findData(options.places).string()));
    parsing.host_entries = places->names();
  }
  const CheckReport report = reportOn(options, missions, types, parsing.trees_elsewhere, places);
  if (!options.draw.empty() && report.problems.empty()) draw(options, *types, missions.front().file, parsing);
  if (!options.dry_run.empty() && report.problems.empty()) {
    if (!options.json) print(report, missions.size());
    return showDryRun({missions.front().file, options.dry_run, options.mock_leaves, options.json, parsing}, *types);
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
  command.option("--places", options->places, "The topological map they are to be flown with, whose places they name.");
  command.leavesOption(options->leaves);
  command.option("--dry-run", options->dry_run,
                 "Also tick the mission, with answers of its leaves from this script, and print what happens: lines as "
                 "`TakeOff: RUNNING x3, SUCCESS`. The exit code is 1 unless the mission ends with SUCCESS.");
  command.option("--draw", options->draw, "Also write a picture of the tree into this file (SVG).");
  command.flag("--headless", options->headless,
               "They are to be flown without the page: also warn of what waits for an operator.");
  command.flag(
      "--mock-leaves", options->mock_leaves,
      "Let nodes that Swiftlet does not have be mocks, and say whose each node is; such a mission cannot be flown. Of "
      "several files each may use the trees of all.");
  command.flag("--json", options->json, "Print the problems as JSON.");
  command.footer("Example: swiftlet check missions/*.xml --system swiftlet_3d");
  command.runs([options] { return check(*options); });
}

}  // namespace swiftlet::apps
