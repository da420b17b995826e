// Unfinished work, machine paths, names of tests and messages, links, scripts and presets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "tests/repository/source_tree.hpp"

namespace swiftlet::repository {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

bool isWordCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool hasWord(const std::string& line, const std::string& word) {
  for (auto at = line.find(word); at != std::string::npos; at = line.find(word, at + 1)) {
    const bool begins = at == 0 || !isWordCharacter(line[at - 1]);
    const bool ends = at + word.size() >= line.size() || !isWordCharacter(line[at + word.size()]);
    if (begins && ends) return true;
  }
  return false;
}

/// "file:line: text" of every line of the files with those endings that has one of the words.
std::vector<std::string> linesWith(const std::vector<std::string>& words, const std::vector<std::string>& endings) {
  std::vector<std::string> found;
  for (const auto& [path, text] : trackedFiles()) {
    if (path == "tests/repository/habits_test.cpp" || !endsWithAny(path, endings)) continue;
    int number = 0;
    for (const std::string& line : linesOf(text)) {
      ++number;
      for (const std::string& word : words)
        if (hasWord(line, word)) found.push_back(path + ":" + std::to_string(number) + ": " + line);
    }
  }
  return found;
}

TEST(Files, ContainNoMarksOfUnfinishedWork) {
  const auto marked = linesWith({"TODO", "FIXME", "XXX", "HACK", "TBD"}, {""});
  EXPECT_THAT(marked, IsEmpty()) << joined(marked);
  const auto said = linesWith({"not implemented", "not yet implemented", "placeholder", "for now"}, {".cpp", ".hpp"});
  EXPECT_THAT(said, IsEmpty()) << joined(said);
}

TEST(Files, NameNoMachinePaths) {
  std::vector<std::string> found;
  for (const auto& [path, text] : trackedFiles()) {
    if (path == "tests/repository/habits_test.cpp") continue;
    int number = 0;
    for (const std::string& line : linesOf(text)) {
      ++number;
      for (const std::string place : {"/home/", "/root/", "/Users/", SWIFTLET_SOURCE_DIR "/"})
        if (const auto at = line.find(place); at != std::string::npos && (at == 0 || !isWordCharacter(line[at - 1])))
          found.push_back(path + ":" + std::to_string(number) + ": " + line);
    }
  }
  EXPECT_THAT(found, IsEmpty()) << joined(found);
}

// Time and chance are injected, and only the job pool and what runs whole flights own threads; otherwise a flight would
// not repeat.
TEST(Files, LibrariesUseNoClockRandomnessOrThreadsOfTheirOwn) {
  const std::vector<std::string> forbidden = {"_clock::now",  "std::rand",    "srand(",       "random_device",
                                              "std::thread(", "std::thread ", "std::jthread", "std::async",
                                              "sleep_for",    "sleep_until"};
  std::vector<std::string> found;
  for (const auto& [path, text] : trackedFiles()) {
    const std::string top = topFolderOf(path);
    if (!endsWithAny(path, {".cpp", ".hpp"}) || top == "apps" || top == "flight" || top == "simulated_flight" ||
        top == "tests" || top == "benchmarks" || top == "fuzz" || path.starts_with("common/jobs."))
      continue;
    int number = 0;
    for (const std::string& line : linesOf(text)) {
      ++number;
      const std::string code = line.substr(0, line.find("//"));
      for (const std::string& word : forbidden)
        if (code.find(word) != std::string::npos) found.push_back(path + ":" + std::to_string(number) + ": " + line);
    }
  }
  EXPECT_THAT(found, IsEmpty()) << joined(found);
}

/// What is wrong with the names of the tests in a file: "line: text".
std::vector<std::string> oddTestNames(const std::string& text) {
  static const std::regex kBegins("^(TEST(_F|_P)?|TYPED_TEST(_P)?|RC_GTEST_(FIXTURE_|TYPED_FIXTURE_)?PROP)\\(.*");
  static const std::regex kNamed("^[A-Z_]+\\( *[A-Z][A-Za-z0-9]*, *[A-Z][A-Za-z0-9]*[,)].*");
  const std::vector<std::string> lines = linesOf(text);
  std::vector<std::string> found;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!std::regex_match(lines[i], kBegins)) continue;
    std::string head = lines[i];  // The suite and the name may each be on a line of their own.
    for (std::size_t j = i + 1; j < std::min(i + 3, lines.size()); ++j) head += lines[j];
    if (!std::regex_match(head, kNamed)) found.push_back(std::to_string(i + 1) + ": " + lines[i]);
  }
  return found;
}

TEST(Files, TestNamesUseOneCase) {
  for (const auto& [path, text] : trackedFiles()) {
    if (!path.starts_with("tests/") || !path.ends_with(".cpp") || path == "tests/repository/habits_test.cpp") continue;
    const std::vector<std::string> found = oddTestNames(text);
    EXPECT_THAT(found, IsEmpty()) << path << ": tests are named LikeThis\n" << joined(found);
  }
}

TEST(Files, APlantedTestNameInAnotherCaseIsCaught) {
  EXPECT_THAT(oddTestNames("TEST(Room, SaysSo) {\nRC_GTEST_PROP(Room, SaysSo, ()) {\n"), IsEmpty());
  EXPECT_THAT(oddTestNames("TEST_F(Room,\n       SaysSo) {\nTYPED_TEST(\n    Room,\n    SaysSo) {\n"), IsEmpty());
  EXPECT_THAT(oddTestNames("TYPED_TEST(Room, says) {\n"), SizeIs(1));
  EXPECT_THAT(oddTestNames("\nTEST_F(Room,\n       Says_so) {\n"), ElementsAre("2: TEST_F(Room,"));
  EXPECT_THAT(oddTestNames("RC_GTEST_FIXTURE_PROP(\n    Room,\n    says, ()) {\n"), SizeIs(1));
  EXPECT_THAT(oddTestNames("TEST(Room, saysSo) {\n"), SizeIs(1));
  EXPECT_THAT(oddTestNames("\nTEST_P(Room, Says_so) {\n"), ElementsAre("2: TEST_P(Room, Says_so) {"));
}

std::string withoutComments(std::string page) {
  for (auto begin = page.find("<!--"); begin != std::string::npos; begin = page.find("<!--", begin))
    page.erase(begin, page.find("-->", begin) - begin);
  return page;
}

TEST(Files, LinksBetweenPagesHaveTargets) {
  for (const auto& [path, page] : trackedFiles()) {
    if (!path.ends_with(".md")) continue;
    const std::string text = withoutComments(page);
    for (auto at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
      std::string target = text.substr(at + 2, text.find(')', at) - at - 2);
      target = target.substr(0, target.find('#'));
      if (target.empty() || target.find("://") != std::string::npos) continue;
      const auto file = std::filesystem::path(SWIFTLET_SOURCE_DIR) / folderOf(path) / target;
      EXPECT_TRUE(std::filesystem::exists(file)) << path << " links to " << target << ", which is not there";
    }
  }
}

TEST(Scripts, EachHasAHelpText) {
  int count = 0;
  for (const auto& [path, text] : trackedFiles()) {
    if (!path.starts_with("scripts/") || path.ends_with(".txt")) continue;
    ++count;
    const Answer answer = run(path + " --help");
    EXPECT_EQ(answer.exit_code, 0) << path << ": " << answer.text;
    EXPECT_TRUE(answer.text.starts_with(path)) << path << " --help begins with its own name:\n" << answer.text;
    EXPECT_THAT(answer.text, HasSubstr("\nExample: ")) << path;
    EXPECT_THAT(answer.text, HasSubstr("--help")) << path;
    EXPECT_EQ(run("bash -n " + path).exit_code, 0) << path;
  }
  EXPECT_GE(count, 6);
}

TEST(Scripts, RefuseUnknownOptions) {
  for (const std::string script : {"setup", "build", "format", "messages", "tidy", "fuzz"}) {
    const Answer answer = run("scripts/" + script + " --frobnicate");
    EXPECT_EQ(answer.exit_code, 2) << script << ": " << answer.text;
    EXPECT_THAT(answer.text, HasSubstr("--frobnicate")) << script;
  }
}

/// The only test of what messages say; others ask for their names.
TEST(Messages, ThePageIsThatOfTheSources) {
  const Answer answer = run("scripts/messages --check");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
}

TEST(Messages, EachNameIsOfItsFormAndHasOneText) {
  const auto page = [](const std::string& source) {
    const auto file = std::filesystem::temp_directory_path() / ("swiftlet-messages-" + std::to_string(::getpid()));
    std::ofstream(file) << source;
    Answer answer = run("scripts/messages " + file.string());
    std::filesystem::remove(file);
    return answer;
  };
  const Answer whole = page("Message(\"map.no-image\", \"no \\\"{}\\\" \"\n  \"| here\", name)");
  EXPECT_EQ(whole.exit_code, 0) << whole.text;
  EXPECT_THAT(whole.text, HasSubstr("\n| `map.no-image` | no \"{}\" \\| here |"));
  for (const char* name : {"map", "map.noImage", "Map.no-image", "map.no_image", "map.-no"}) {
    const Answer odd = page("Message(\"" + std::string(name) + "\", \"a\")");
    EXPECT_EQ(odd.exit_code, 1) << odd.text;
    EXPECT_THAT(odd.text, HasSubstr("`" + std::string(name) + "`"));
  }
  EXPECT_EQ(page("Message(\"a.b\", \"c\") Message(\"a.b\", \"c\", 1)").exit_code, 0);
  EXPECT_EQ(page("Message(\"a.b\", \"c\") Message(\"a.b\", \"d\")").exit_code, 1);
}

TEST(Scripts, FuzzListsExistingFuzzersAndEachHasSeeds) {
  std::istringstream example(run("scripts/fuzz --help").text);
  std::set<std::string> fuzzers;
  for (std::string word; example >> word;)
    if (word.starts_with("fuzz_")) fuzzers.insert(word);
  EXPECT_FALSE(fuzzers.empty());
  for (const std::string& name : fuzzers) EXPECT_TRUE(trackedFiles().contains("fuzz/" + name + ".cpp")) << name;
  for (const auto& [path, text] : trackedFiles()) {
    if (!path.starts_with("fuzz/fuzz_") || !path.ends_with(".cpp")) continue;
    const auto seeds = std::filesystem::path(SWIFTLET_SOURCE_DIR) / "fuzz/seeds" / std::filesystem::path(path).stem();
    EXPECT_TRUE(std::filesystem::is_directory(seeds) && !std::filesystem::is_empty(seeds)) << seeds;
  }
}

TEST(Presets, AreComplete) {
  const auto presets = nlohmann::json::parse(trackedFiles().at("CMakePresets.json"));
  std::set<std::string> configured, built;
  for (const auto& preset : presets.at("configurePresets"))
    if (!preset.value("hidden", false)) configured.insert(preset.at("name"));
  for (const auto& preset : presets.at("buildPresets")) built.insert(preset.at("configurePreset"));
  const std::set<std::string> expected = {"release", "dev", "asan", "tsan", "coverage", "fuzz"};
  EXPECT_EQ(configured, expected);
  EXPECT_EQ(built, expected);
  EXPECT_EQ(run("cmake --list-presets").exit_code, 0);
}

}  // namespace
}  // namespace swiftlet::repository
