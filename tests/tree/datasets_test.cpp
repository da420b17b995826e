// Trees of other projects: BehaviorTree.CPP's examples and fuzzing corpus, Groot's, Nav2's, Aerostack2's. Those of
// version 4 are read, with their node types registered as the problems name them; all others are refused with a place.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>

#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/nodes/sequence.hpp"
#include "behaviors/tree/parser.hpp"
#include "tests/support/datasets.hpp"

namespace swiftlet::tree {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> filesOf(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".xml") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string textOf(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The text at a problem's place must be the subject of the problem.
std::string lineAt(const Location& place) {
  std::ifstream file(place.file);
  std::string line;
  for (int i = 0; i < place.line; ++i) std::getline(file, line);
  return place.column > 0 && place.column <= static_cast<int>(line.size())
             ? line.substr(static_cast<std::size_t>(place.column - 1))
             : "";
}

class Nothing final : public Leaf {
  using Leaf::Leaf;
  Status act(TickContext&) override { return Status::kSuccess; }
};

/// Learns node types from the problems they cause, as a user would register them.
class Learner {
 public:
  /// False when the problem is about something else.
  bool learn(const Problem& problem, const std::string& text) {
    const std::string name(problem.message.name());
    std::smatch match;
    std::regex_search(problem.message.text(), match, std::regex("[`{]([^`}]+)"));  // What is unknown or not set.
    if (name == "tree.unknown-node" || name == "tree.foreign-node") {
      NodeManifest& manifest = manifests_[match[1]];
      manifest.id = match[1];
      // A type is a control node when it has children anywhere in the file.
      const bool has_children = std::regex_search(text, std::regex("</" + manifest.id + ">"));
      manifest.kind = has_children                     ? NodeKind::kControl
                      : problem.element == "Condition" ? NodeKind::kCondition
                                                       : NodeKind::kAction;
      return true;
    }
    if (name == "tree.unknown-port" && manifests_.contains(problem.element)) {
      manifests_[problem.element].ports.push_back(
          {.name = match[1], .type = PortType::kString, .direction = Direction::kInOut});
      return true;
    }
    // Entries are filled by the host, or by outputs we cannot tell from inputs.
    if (name == "tree.entry-unset") {
      options.host_entries.push_back(match[1]);
      return true;
    }
    return false;
  }

  Registry registry() const {
    Registry registry = Registry::standard();
    for (const auto& [id, manifest] : manifests_) {
      if (manifest.kind == NodeKind::kControl)
        registry.add(manifest, [](const NodeSetup& setup) { return std::make_unique<Sequence>(setup); });
      else
        registry.add(manifest, [](const NodeSetup& setup) { return std::make_unique<Nothing>(setup); });
    }
    return registry;
  }

  ParseOptions options;

 private:
  std::map<std::string, NodeManifest> manifests_;
};

/// Reads the file and registers node types in turn, until it is read or the remaining problems are not about
/// registration.
std::vector<Problem> readByLearning(const fs::path& path, bool& read) {
  Learner learner;
  learner.options.limits.problems = 10'000;
  for (int round = 0; round < 4; ++round) {
    const Registry registry = learner.registry();
    ParseResult result = parseFile(path.string(), registry, learner.options);
    read = result.tree.has_value();
    if (read) {
      TickContext context;
      for (int i = 0; i < 10; ++i) result.tree->tick(context);
      return {};
    }
    bool learned = false;
    for (const Problem& problem : result.problems) learned = learner.learn(problem, textOf(path)) || learned;
    if (!learned) return result.problems;
  }
  return {};
}

TEST(TreesOfOtherProjects, AreReadOrRefusedWithThePlace) {
  const auto folder = test_support::dataSet("08-behavior-trees");
  if (!folder) return;
  int read_count = 0, refused = 0;
  for (const fs::path& path : filesOf(*folder)) {
    bool read = false;
    const std::vector<Problem> problems = readByLearning(path, read);
    (read ? read_count : refused)++;
    EXPECT_NE(read, !problems.empty()) << path;
    const bool version3 = std::regex_search(textOf(path), std::regex("<SequenceStar|<BlackboardCheck|<SubTreePlus"));
    EXPECT_FALSE(version3 && read) << path << " is of version 3";
    for (const Problem& problem : problems) {
      EXPECT_GT(problem.location.line, 0) << toString(problem);
      EXPECT_FALSE(lineAt(problem.location).empty()) << toString(problem);
    }
  }
  std::cout << read_count << " read, " << refused << " refused\n";
  EXPECT_GE(read_count, 20) << "format 4 files of others that use nothing but nodes and includes must be read";
}

}  // namespace
}  // namespace swiftlet::tree
