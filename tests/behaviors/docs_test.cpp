// Runs docs/behaviors.md: each XML block is followed by the table of its ticks, by its problems, or is a valid mission.
#include <fstream>
#include <optional>
#include <sstream>

#include <gtest/gtest.h>

#include "behaviors/mission_check.hpp"
#include "behaviors/tree/registry.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::behaviors {
namespace {

using Row = std::vector<std::string>;

struct Example {
  int line = 0;
  std::string xml;
  std::vector<Row> table;               ///< The first row is the head.
  std::optional<std::string> problems;  ///< A text block.
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

Row cellsOf(const std::string& line) {
  Row cells;
  std::stringstream rest(line.substr(1));
  for (std::string cell; std::getline(rest, cell, '|');) cells.push_back(trimmed(cell));
  return cells;
}

std::string readBlock(std::istream& file, int& number) {
  std::string block;
  for (std::string line; std::getline(file, line) && ++number && line != "```";) block += line + "\n";
  return block;
}

std::vector<Example> examples() {
  std::ifstream file(SWIFTLET_SOURCE_DIR "/docs/behaviors.md");
  std::vector<Example> found;
  bool follows = false;  // Only blanks since the last XML block.
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line == "```xml") {
      const int start = number;
      found.push_back({start, readBlock(file, number), {}, {}});
      follows = true;
    } else if (line == "```text" && follows) {
      found.back().problems = readBlock(file, number);
    } else if (line.starts_with("|") && follows) {
      if (!line.starts_with("| ---")) found.back().table.push_back(cellsOf(line));
    } else if (!line.empty()) {
      follows = false;
    }
  }
  return found;
}

std::string problemsOf(const std::string& xml) {
  std::string text;
  for (const common::Problem& problem : toCommon(judgeMissionText(xml, "mission.xml").problems))
    text += toString(problem) + "\n";
  return text;
}

void run(const Example& example) {
  tree::testing::Story story(example.xml);
  ASSERT_TRUE(story.problems().empty()) << toString(story.problems());
  const Row& head = example.table.front();
  const std::size_t actors = head.size() - 3;
  ASSERT_EQ(head.front(), "ms");
  ASSERT_EQ(head.back(), "what happens");
  for (std::size_t r = 1; r < example.table.size(); ++r) {
    const Row& row = example.table[r];
    ASSERT_EQ(row.size(), head.size());
    for (std::size_t i = 1; i <= actors; ++i) story.says(head[i].substr(0, 1), row[i]);
    const std::string expected = row[actors + 1] + (row.back().empty() ? "" : ": " + row.back());
    EXPECT_EQ(story.tick(std::stoi(row.front())), expected) << "row " << r;
  }
}

TEST(Docs, EveryExampleBehavesAsDocumented) {
  int stories = 0, problems = 0, sound = 0;
  for (const Example& example : examples()) {
    SCOPED_TRACE("docs/behaviors.md:" + std::to_string(example.line));
    if (!example.table.empty()) {
      run(example);
      ++stories;
    } else {
      EXPECT_EQ(problemsOf(example.xml), example.problems.value_or(""));
      ++(example.problems ? problems : sound);
    }
  }
  EXPECT_GE(stories, 10);
  EXPECT_GE(problems, 3);
  EXPECT_GE(sound, 2);
}

TEST(Docs, NameEveryNodeOfTheEngine) {
  std::ifstream file(SWIFTLET_SOURCE_DIR "/docs/behaviors.md");
  std::stringstream text;
  text << file.rdbuf();
  for (const std::string& id : tree::Registry::standard().ids())
    EXPECT_NE(text.str().find(id), std::string::npos) << id << " is not in docs/behaviors.md";
}

}  // namespace
}  // namespace swiftlet::behaviors
