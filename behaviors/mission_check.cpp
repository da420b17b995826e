#include "behaviors/mission_check.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "behaviors/flight_order.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/limits_check.hpp"
#include "behaviors/mission_warnings.hpp"
#include "behaviors/place_entries.hpp"
#include "behaviors/tree/mocks.hpp"
#include "behaviors/tree/parser.hpp"

namespace swiftlet::behaviors {
namespace {

MissionVerdict verdictOf(tree::ParseResult parsed, const MissionLimits& limits) {
  if (parsed.tree) {
    parsed.problems = semanticProblems(*parsed.tree, limits);
    const std::vector<tree::Problem> found = missionWarnings(*parsed.tree, limits);
    parsed.warnings.insert(parsed.warnings.end(), found.begin(), found.end());
  }
  return {std::move(parsed.problems), std::move(parsed.warnings), {}};
}

/// "3 of the engine: Sequence, Timeout", one line for each owner that has a node in the tree.
std::vector<std::string> ownersOf(const tree::Tree& tree, const std::vector<tree::Mock>& mocks) {
  struct Owner {
    const char* title;
    int nodes = 0;
    std::map<std::string, std::string> types = {};  ///< With a remark.
  };
  std::array<Owner, 4> owners = {{{"of the engine"}, {"of Swiftlet"}, {"of --leaves"}, {"mocks"}}};
  const tree::Registry engine = tree::Registry::standard(), swiftlet = missionRegistry();
  for (const tree::NodeRecord& record : tree.nodes()) {
    const std::string id(typeNameOf(record));
    const auto mock = std::find_if(mocks.begin(), mocks.end(), [&](const tree::Mock& known) { return known.id == id; });
    const bool of_engine = record.manifest == nullptr || engine.find(id) != nullptr;
    Owner& owner = owners[mock != mocks.end() ? 3 : of_engine ? 0 : swiftlet.find(id) != nullptr ? 1 : 2];
    ++owner.nodes;
    std::string& remark = owner.types[id];
    if (mock == mocks.end()) continue;
    if (!mock->instead_of_port.empty())
      remark = " (Swiftlet's has no port `" + mock->instead_of_port + "`)";
    else if (!record.node->children().empty())
      remark = " (as a Sequence)";
  }
  std::vector<std::string> lines;
  for (const Owner& owner : owners) {
    if (owner.nodes == 0) continue;
    std::string line = std::to_string(owner.nodes) + " " + owner.title + ":";
    for (const auto& [id, remark] : owner.types) line += (line.ends_with(':') ? " " : ", ") + std::string(id) + remark;
    lines.push_back(std::move(line));
  }
  return lines;
}

/// A node that is not of the engine.
bool hasBehaviour(const tree::Tree& tree) {
  const tree::Registry engine = tree::Registry::standard();
  return std::any_of(tree.nodes().begin(), tree.nodes().end(), [&](const tree::NodeRecord& record) {
    return record.manifest != nullptr && engine.find(record.manifest->id) == nullptr;
  });
}

}  // namespace

MissionVerdict judgeMission(const std::string& path, const MissionLimits& limits, const tree::Registry& types,
                            const tree::TreeFiles& together) {
  tree::ParseOptions options = parseOptionsOf(limits);
  options.trees_elsewhere = together;
  return verdictOf(tree::parseFile(path, types, options), limits);
}

MissionVerdict judgeMissionWithMocks(const std::string& path, const MissionLimits& limits, const tree::Registry& types,
                                     const tree::TreeFiles& together) {
  tree::ParseOptions options = parseOptionsOf(limits);
  options.trees_elsewhere = together;
  options.user_sets_entries = together.helpers.contains(path);
  const tree::MockedRegistry mocked = tree::withMocks(path, types, options);
  tree::ParseResult parsed = tree::parseFile(path, mocked.registry, mocked.options);
  std::vector<std::string> whose;
  if (parsed.tree) whose = ownersOf(*parsed.tree, mocked.mocks);
  const bool foreign = !mocked.mocks.empty() || (parsed.tree && !hasBehaviour(*parsed.tree));
  if (parsed.tree && (foreign || options.user_sets_entries)) return {{}, std::move(parsed.warnings), std::move(whose)};
  MissionVerdict verdict = verdictOf(std::move(parsed), limits);
  if (verdict.problems.empty()) verdict.whose = std::move(whose);
  return verdict;
}

MissionVerdict judgeMissionText(const std::string& text, const std::string& name, const MissionLimits& limits) {
  return verdictOf(tree::parseText(text, name, missionRegistry(), parseOptionsOf(limits)), limits);
}

std::vector<common::Problem> toCommon(const std::vector<tree::Problem>& problems) {
  std::vector<common::Problem> result;
  for (const tree::Problem& problem : problems) {
    common::Problem shown{{problem.location.file, problem.location.line, problem.location.column},
                          problem.element,
                          common::Message(problem.message.name(), "{}", problem.message.text()),
                          problem.hint};
    const std::string path = problem.path.empty() ? "" : " [" + problem.path + "]";
    if (shown.hint.empty())
      shown.message += path;
    else
      shown.hint += path;
    result.push_back(std::move(shown));
  }
  return result;
}

tree::Problem toTree(const common::Problem& problem) {
  return {{problem.location.file, problem.location.line, problem.location.column},
          problem.element,
          tree::Message(problem.message.name(), "{}", problem.message.text()),
          problem.hint};
}

std::vector<std::string> mapFilesOf(const tree::Tree& tree) {
  std::vector<std::string> files;
  for (const tree::NodeRecord& record : tree.nodes()) {
    if (traitsOf(record).map != MapUse::kLoads) continue;
    for (const tree::Value& value : tree.knownValues(record.node->id(), "file"))
      if (const auto* file = std::get_if<std::string>(&value))
        if (std::find(files.begin(), files.end(), *file) == files.end()) files.push_back(*file);
  }
  return files;
}

std::vector<tree::Problem> semanticProblems(const tree::Tree& tree, const MissionLimits& limits) {
  std::vector<tree::Problem> problems = flightOrderProblems(tree);
  for (tree::Problem& problem : limitProblems(tree, limits)) problems.push_back(std::move(problem));
  return problems;
}

std::vector<tree::Problem> operatorWarnings(const std::string& path, const MissionLimits& limits,
                                            const tree::Registry& types) {
  const tree::ParseResult parsed = tree::parseFile(path, types, parseOptionsOf(limits));
  return parsed.tree ? operatorWarnings(*parsed.tree, limits) : std::vector<tree::Problem>();
}

std::vector<common::Problem> checkMission(const std::string& path, const MissionLimits& limits,
                                          const tree::Registry& types) {
  return toCommon(judgeMission(path, limits, types).problems);
}

}  // namespace swiftlet::behaviors
