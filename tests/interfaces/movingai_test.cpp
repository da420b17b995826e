// Grids and path problems of the Moving AI benchmarks: read, and refused with line and column.
#include "interfaces/files/movingai.hpp"

#include <gmock/gmock.h>

#include "support.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::interfaces {
namespace {

using common::occupancy::isFree;
using common::occupancy::isOccupied;
using test_support::HasProblem;
using test_support::problemsOf;

const std::string kHeader = "type octile\nheight 3\nwidth 4\nmap\n";
const std::string kMap = kHeader + "@.GS\nTW..\nO...\n";

TEST(MovingAi, RowsCountFromTheTop) {
  const OctileMap map = parseOctileMap(kMap, "m.map", 0.5);
  EXPECT_EQ(map.width, 4);
  EXPECT_EQ(map.height, 3);
  EXPECT_EQ(map.grid.resolution_m(), 0.5);
  EXPECT_EQ(map.cellAt(1, 0), (common::CellIndex{1, 2}));
  for (const auto& [column, row] : {std::pair{0, 0}, {0, 1}, {1, 1}, {0, 2}})
    EXPECT_TRUE(isOccupied(map.grid.at(map.cellAt(column, row)))) << column << " " << row;
  for (const auto& [column, row] : {std::pair{1, 0}, {2, 0}, {3, 0}, {2, 1}, {3, 2}})
    EXPECT_TRUE(isFree(map.grid.at(map.cellAt(column, row)))) << column << " " << row;
  EXPECT_EQ(common::knownExtent(map.grid), (common::CellRect{{0, 0}, {4, 3}}));
  const std::string windows = "type octile\r\nheight 1\r\nwidth 2\r\nmap\r\n.@\r\n";
  EXPECT_TRUE(isOccupied(parseOctileMap(windows, "m.map", 1.0).grid.at({1, 0})));
}

TEST(MovingAi, ReportThePlaceOfMistakesInAMap) {
  const auto problem = [](const std::string& text) { return problemsOf([&] { parseOctileMap(text, "m.map", 1.0); }); };
  EXPECT_THAT(problem(""), HasProblem("movingai.no-size", "m.map"));
  EXPECT_THAT(problem("type octile\nmap\n"), HasProblem("movingai.no-size", "m.map:2"));
  EXPECT_THAT(problem("P5\n1 1\n"), HasProblem("movingai.no-header", "m.map:1:1"));
  EXPECT_THAT(problem("height 0\n"), HasProblem("movingai.side", "m.map:1:1: height"));
  EXPECT_THAT(problem("height 1000000\n"), HasProblem("movingai.side", "m.map:1:1: height"));
  EXPECT_THAT(problem("width 2.5\n"), HasProblem("movingai.side", "m.map:1:1: width"));
  EXPECT_THAT(problem(kHeader + "....\n"), HasProblem("movingai.rows", "m.map:5"));
  EXPECT_THAT(problem(kHeader + "....\n...\n....\n"), HasProblem("movingai.columns", "m.map:6"));
  EXPECT_THAT(problem(kHeader + "..x.\n....\n....\n"), HasProblem("movingai.cell", "m.map:5:3"));
}

TEST(MovingAi, ReadProblems) {
  const auto problems = parseGridProblems("version 1\n0\tmaps/m.map\t4\t3\t1\t0\t3\t2\t2.82842712\n", "m.scen", 4, 3);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].start_column, 1);
  EXPECT_EQ(problems[0].start_row, 0);
  EXPECT_EQ(problems[0].goal_column, 3);
  EXPECT_EQ(problems[0].goal_row, 2);
  EXPECT_DOUBLE_EQ(problems[0].optimal_length, 2.82842712);
  EXPECT_EQ(problems[0].line, 2);
}

TEST(MovingAi, ReportThePlaceOfMistakesInAProblem) {
  const auto problem = [](const std::string& text) {
    return problemsOf([&] { parseGridProblems(text, "m.scen", 4, 3); });
  };
  EXPECT_THAT(problem("0 m 4 3 1 0 3\n"), HasProblem("text.number-count", "m.scen:1"));
  EXPECT_THAT(problem("0 m 8 6 1 0 3 2 1\n"), HasProblem("movingai.other-map", "m.scen:1:5"));
  EXPECT_THAT(problem("0 m 4 3 4 0 3 2 1\n"), testing::Not(testing::IsEmpty()));
  EXPECT_THAT(problem("0 m 4 3 1.5 0 3 2 1\n"), HasProblem("movingai.no-cell", "m.scen:1:9"));
  EXPECT_THAT(problem("0 m 4 3 1 -1 3 2 1\n"), testing::Not(testing::IsEmpty()));
}

}  // namespace
}  // namespace swiftlet::interfaces
