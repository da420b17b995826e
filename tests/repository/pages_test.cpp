// The files that pages name exist, and so does the code that decisions name. README and tutorials type no figures.
#include <fnmatch.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>
#include <utility>

#include "tests/repository/source_tree.hpp"

namespace swiftlet::repository {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// The texts between back quotes.
std::vector<std::string> quoted(const std::string& text) {
  static const std::regex kQuoted("`([^`\n]+)`");
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), kQuoted), end; match != end; ++match)
    found.push_back((*match)[1]);
  return found;
}

/// A path from the root of the tree; `*` stands for any text, and a file may be named without its ending.
bool exists(std::string path, const Files& files) {
  if (path.ends_with('/')) path.pop_back();
  return std::any_of(files.begin(), files.end(), [&](const auto& file) {
    const std::string& name = file.first;
    return name.starts_with(path + "/") || name.starts_with(path + ".") || fnmatch(path.c_str(), name.c_str(), 0) == 0;
  });
}

/// The quoted paths of a page that begin with a folder of the tree and name nothing in it.
std::vector<std::string> missingPaths(const std::string& page, const Files& files) {
  static const std::regex kPath("[A-Za-z0-9_][A-Za-z0-9_./*-]+");
  std::set<std::string> folders;
  for (const auto& [path, text] : files) folders.insert(topFolderOf(path));
  std::vector<std::string> missing;
  for (const std::string& path : quoted(page)) {
    const bool is_path = path.find('/') != std::string::npos && std::regex_match(path, kPath);
    if (is_path && folders.contains(topFolderOf(path)) && !exists(path, files)) missing.push_back(path);
  }
  return missing;
}

bool isUpper(char c) { return c >= 'A' && c <= 'Z'; }

/// The quoted names of types and functions in a page of decisions, up to what else was tried, that are not in the code.
std::vector<std::string> missingNames(const std::string& page, const std::string& code) {
  static const std::regex kName("[A-Za-z_][A-Za-z0-9_]*"), kCode("[A-Za-z_][A-Za-z0-9_:]*(\\(\\))?");
  std::vector<std::string> missing;
  for (const std::string& text : quoted(page.substr(0, page.find("\n## What else was tried")))) {
    if (!std::regex_match(text, kCode) || std::ranges::none_of(text, isUpper)) continue;
    for (std::sregex_iterator name(text.begin(), text.end(), kName), end; name != end; ++name)
      if (code.find(name->str()) == std::string::npos) missing.push_back(name->str());
  }
  return missing;
}

TEST(Pages, NameFilesThatExist) {
  for (const auto& [path, page] : trackedFiles()) {
    if (!path.ends_with(".md") || path == "CHANGELOG.md") continue;
    const auto missing = missingPaths(page, trackedFiles());
    EXPECT_THAT(missing, IsEmpty()) << path << " names what is not there:\n" << joined(missing);
  }
}

TEST(Pages, DecisionsNameCodeThatExists) {
  std::string code;
  for (const auto& [path, text] : trackedFiles())
    if (!path.ends_with(".md") && path != "tests/repository/pages_test.cpp") code += text;
  for (const auto& [path, page] : trackedFiles()) {
    if (!path.starts_with("docs/decisions/") || path.ends_with("README.md")) continue;
    const auto missing = missingNames(page, code);
    EXPECT_THAT(missing, IsEmpty()) << path << " names what is not in the code:\n" << joined(missing);
  }
}

TEST(Pages, PlantedMistakesAreCaught) {
  const Files files = {
      {"common/jobs.hpp", ""}, {"common/world/map_layer.hpp", ""}, {"config/systems/swiftlet.yaml", ""}};
  EXPECT_THAT(
      missingPaths("`common/jobs`, `common/jobs.*`, `common/world/`, `runs/first`, `/api/state`, `a/b c`", files),
      IsEmpty());
  EXPECT_THAT(missingPaths("`common/job.hpp` and `config/systems/swift_*.yaml`", files),
              ElementsAre("common/job.hpp", "config/systems/swift_*.yaml"));
  const std::string page = "`Jobs::submit` in `common/jobs.hpp`\n\n## What else was tried\n\n`OldName`\n";
  EXPECT_THAT(missingNames(page, "class Jobs { void submit(); };"), IsEmpty());
  EXPECT_THAT(missingNames(page, "class Jobs { void post(); };"), ElementsAre("submit"));
}

/// The page without its fenced blocks.
std::string proseOf(const std::string& page) {
  std::string prose;
  bool in_block = false;
  for (const std::string& line : linesOf(page)) {
    if (line.starts_with("```"))
      in_block = !in_block;
    else if (!in_block)
      prose += line + "\n";
  }
  return prose;
}

/// What is a number of that form with a unit behind it: "0.014 m", "5.2 s", "90 %".
std::vector<std::string> figuresIn(const std::string& prose, const std::string& number) {
  const std::regex figure("(?:^|[^A-Za-z0-9_.])(" + number +
                          " ?(m|cm|mm|s|ms|m/s|deg|degrees|%|kB|scans)(?![A-Za-z0-9/-]))");
  std::vector<std::string> found;
  for (std::sregex_iterator match(prose.begin(), prose.end(), figure), end; match != end; ++match)
    found.push_back((*match)[1]);
  return found;
}

std::vector<std::string> typedFigures(const std::string& page) {
  return figuresIn(proseOf(page), "[0-9]+(\\.[0-9]+)?");
}

/// Figures with two decimals or more in paragraphs that name no source such as "(Hess et al. 2016)". The sizes and
/// settings that a tutorial names have fewer decimals.
std::vector<std::string> typedResults(const std::string& page) {
  static const std::regex kSource("\\([A-Z][^()]* (19|20)[0-9][0-9]\\)");
  const std::string prose = proseOf(page);
  std::vector<std::string> found;
  for (std::size_t begin = 0, end = 0; begin < prose.size(); begin = end + 2) {
    end = std::min(prose.find("\n\n", begin), prose.size());
    const std::string paragraph = prose.substr(begin, end - begin);
    if (std::regex_search(paragraph, kSource)) continue;
    for (std::string& figure : figuresIn(paragraph, "[0-9]+\\.[0-9][0-9]+")) found.push_back(std::move(figure));
  }
  return found;
}

// Figures belong into a block of a tutorial, where tests/tutorials/run_page.sh makes them.
TEST(Pages, TheReadmeContainsNoTypedFigures) {
  const auto typed = typedFigures(trackedFiles().at("README.md"));
  EXPECT_THAT(typed, IsEmpty()) << joined(typed);
  EXPECT_THAT(
      typedFigures("0.014 m on Intel, 20 % faster\n```sh\nsleep 5 s\n```\n6-DOF, 2D, corridor_40m, Debian 12 machine"),
      ElementsAre("0.014 m", "20 %"));
}

TEST(Pages, TutorialsContainNoTypedResults) {
  for (const auto& [path, page] : trackedFiles()) {
    if (!path.starts_with("docs/tutorials/") || !path.ends_with(".md")) continue;
    const auto typed = typedResults(page);
    EXPECT_THAT(typed, IsEmpty()) << path << " has figures outside of the blocks that its test makes:\n"
                                  << joined(typed);
  }
}

TEST(Pages, APlantedResultInATutorialIsCaught) {
  EXPECT_THAT(typedResults("A room of 5 m, a beam up to 0.5 m/s.\n\nIt is 0.014 m off,\nand 0.25 % of it.\n"),
              ElementsAre("0.014 m", "0.25 %"));
  EXPECT_THAT(typedResults("```text\nmean 0.014 m `a`\n```\n\nA mean of 0.0229 m was published (Hess et al. 2016).\n"),
              IsEmpty());
}

}  // namespace
}  // namespace swiftlet::repository
