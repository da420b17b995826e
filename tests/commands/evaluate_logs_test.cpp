// `swiftlet evaluate logs`: the short part of the recorded logs is as good as docs/logs.md says, and the page keeps
// what is not the table.
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/datasets.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::readText;
using test_support::runSwiftlet;
using testing::HasSubstr;
using testing::Not;

/// The cells of a row by the names of the columns.
using Row = std::map<std::string, std::string>;

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream words(line.substr(1));
  for (std::string cell; std::getline(words, cell, '|');) {
    const std::size_t begin = cell.find_first_not_of(' '), end = cell.find_last_not_of(' ');
    cells.push_back(begin == std::string::npos ? "" : cell.substr(begin, end - begin + 1));
  }
  return cells;
}

/// Of the first table, by log, part, way and wheels.
std::map<std::string, Row> rowsOf(const std::string& text) {
  std::map<std::string, Row> rows;
  std::vector<std::string> columns;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!columns.empty() && line.empty()) break;
    if (!line.starts_with("| ") || line.starts_with("| ---")) continue;
    const std::vector<std::string> cells = cellsOf(line);
    if (columns.empty()) {
      columns = cells;
      continue;
    }
    Row row;
    for (std::size_t i = 0; i < cells.size() && i < columns.size(); ++i) row[columns[i]] = cells[i];
    rows[row["log"] + ", " + row["part"] + ", " + row["way"] + ", wheels: " + row["wheels"]] = row;
  }
  return rows;
}

class EvaluateLogs : public test_support::Scratch {};

TEST_F(EvaluateLogs, TheShortPartIsAsThePageSays) {
  if (!test_support::dataSet("01-laser-slam")) return;
  test_support::ProgramOptions patient;
  patient.patience = std::chrono::seconds(600);
  const std::string folder = test_support::dataSetsFolder().string();
  const ProgramEnd end = runSwiftlet({"evaluate", "logs", "--part", "short", "--datasets", folder}, patient);
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const auto page = rowsOf(readText(std::filesystem::path(SWIFTLET_SOURCE_DIR) / "docs/logs.md"));
  const auto rows = rowsOf(end.out);
  ASSERT_GE(rows.size(), 8U) << end.out;
  const std::string print = "; to print the page: swiftlet evaluate logs --jobs 2 --out docs/logs.md";
  for (const auto& [name, row] : rows) {
    ASSERT_TRUE(page.contains(name)) << name << print;
    const Row& known = page.at(name);
    for (const char* column : {"map", "trusted"})
      EXPECT_EQ(row.at(column), known.at(column)) << name << ", " << column << print;
    // A map of another machine or compiler may differ a little.
    for (const char* column : {"mean m", "ATE RMS m"}) {
      if (known.at(column).empty()) continue;
      EXPECT_LE(std::stod(row.at(column)), 1.2 * std::stod(known.at(column)) + 0.005)
          << name << ", " << column << print;
    }
  }
}

TEST_F(EvaluateLogs, ThePageKeepsWhatIsNotTheTable) {
  if (!test_support::dataSet("01-laser-slam")) return;
  const std::string folder = test_support::dataSetsFolder().string();
  const auto print = [&](const std::string& page) {
    return runSwiftlet(
        {"evaluate", "logs", "--part", "short", "--log", "edmonton", "--datasets", folder, "--out", page});
  };
  const std::string page = path("logs.md");
  ProgramEnd end = print(page);
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const std::string first = readText(page);
  EXPECT_THAT(first, HasSubstr("| edmonton | first 120 scans "));
  EXPECT_THAT(first, HasSubstr("2 maps in "));
  EXPECT_EQ(rowsOf(first).size(), 2U);
  std::string mine = first + "\nMore.\n";
  mine.replace(mine.find("| edmonton"), 10, "| old");
  end = print(write("logs.md", "Mine.\n" + mine));
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const std::string again = readText(page);
  EXPECT_THAT(again, testing::StartsWith("Mine.\n<!-- written by `swiftlet evaluate logs --out` -->\n"));
  EXPECT_THAT(again, testing::EndsWith("\nMore.\n"));
  EXPECT_THAT(again, Not(HasSubstr("| old")));
  end = print(write("other.md", "Mine.\n"));
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("has no place for the results"));
  EXPECT_EQ(readText(path("other.md")), "Mine.\n");
}

/// Each variation is mapped from scans of its own, and compared with the poses that the scans were recorded at.
TEST_F(EvaluateLogs, MapsVariationsToo) {
  if (!test_support::dataSet("01-laser-slam")) return;
  const ProgramEnd end = runSwiftlet({"evaluate", "logs", "--part", "short", "--log", "edmonton", "--variations",
                                      "--datasets", test_support::dataSetsFolder().string()});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const auto rows = rowsOf(end.out);
  ASSERT_EQ(rows.size(), 12U) << end.out;
  for (const auto& [name, row] : rows) EXPECT_NE(row.at("ATE RMS m"), "") << name;
  const std::string on = ", on, wheels: no", first = "edmonton, first 120 scans, ";
  const Row &stamped = rows.at(first + "growing stamps" + on), &later = rows.at(first + "from the 38th scan on" + on);
  EXPECT_LT(std::stod(later.at("path m")), std::stod(stamped.at("path m")));
  EXPECT_THAT(end.out, HasSubstr("| edmonton | "));
  EXPECT_THAT(end.out, HasSubstr("12 maps in "));
}

TEST_F(EvaluateLogs, RefusesWhatIsNotThere) {
  ProgramEnd end = runSwiftlet({"evaluate", "logs", "--datasets", path("nowhere")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("intel.clf.bz2: is not there"));
  EXPECT_THAT(end.err, HasSubstr("--datasets"));
  end = runSwiftlet({"evaluate", "logs", "--part", "half"});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  if (!test_support::dataSet("01-laser-slam")) return;
  end = runSwiftlet({"evaluate", "logs", "--log", "moon", "--datasets", test_support::dataSetsFolder().string()});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("--log: there is no log `moon`, there are intel, fr079"));
}

}  // namespace
}  // namespace swiftlet::commands
