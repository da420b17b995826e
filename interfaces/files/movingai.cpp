#include "interfaces/files/movingai.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "interfaces/files/line_fields.hpp"
#include "interfaces/files/line_reader.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Message;

constexpr common::occupancy::Cell kFree = -common::occupancy::kMaxSteps, kOccupied = common::occupancy::kMaxSteps;

constexpr const char* kOctileHeader = "a map begins with the lines `type octile`, `height 49`, `width 49`, `map`";

bool nextFilledLine(LineReader& reader, std::string_view& line) {
  while (reader.next(line))
    if (!wordsOf(line).empty()) return true;
  return false;
}

/// The value of the header line "`name` 49".
int sideOf(const LineReader& reader, const std::vector<Word>& words) {
  double value = 0.0;
  if (words.size() != 2 || !parseNumber(words[1].text, value) || value != std::floor(value) || value < 1.0 ||
      value > kMostOctileCells)
    throw reader.problemAt(words[0].column, std::string(words[0].text),
                           Message("movingai.side", "is no number of cells from 1 to {}", kMostOctileCells));
  return static_cast<int>(value);
}

OctileMap headerOf(LineReader& reader, double cell_m) {
  OctileMap map{common::OccupancyGrid(cell_m, common::occupancy::kUnknown)};
  std::string_view line;
  while (nextFilledLine(reader, line)) {
    const std::vector<Word> words = wordsOf(line);
    if (words[0].text == "type") continue;
    if (words[0].text == "map") break;
    if (words[0].text != "height" && words[0].text != "width")
      throw reader.problemAt(words[0].column, "", Message("movingai.no-header", "is no header of a grid"),
                             kOctileHeader);
    (words[0].text == "height" ? map.height : map.width) = sideOf(reader, words);
  }
  if (map.width == 0 || map.height == 0)
    throw reader.problemAt(0, "", Message("movingai.no-size", "width or height is missing"), kOctileHeader);
  return map;
}

bool isGround(const LineReader& reader, std::string_view line, int column) {
  constexpr std::string_view kGround = ".GS", kOther = "@OTW";
  const char cell = line[static_cast<std::size_t>(column)];
  if (kGround.find(cell) != std::string_view::npos) return true;
  if (kOther.find(cell) == std::string_view::npos)
    throw reader.problemAt(column + 1, "", Message("movingai.cell", "`{}` is no kind of cell", cell),
                           "these are: . G S @ O T W");
  return false;
}

OctileMap readMapFrom(LineReader reader, double cell_m) {
  OctileMap map = headerOf(reader, cell_m);
  std::string_view line;
  for (int row = 0; row < map.height; ++row) {
    if (!reader.next(line))
      throw reader.problemAt(0, "", Message("movingai.rows", "ends after {} of {} rows", row, map.height));
    if (line.size() != static_cast<std::size_t>(map.width))
      throw reader.problemAt(0, "", Message("movingai.columns", "has {} cells, not {}", line.size(), map.width));
    for (int column = 0; column < map.width; ++column)
      map.grid.set(map.cellAt(column, row), isGround(reader, line, column) ? kFree : kOccupied);
  }
  return map;
}

const LineFormat& problemFormat() {
  static const LineFormat kFormat{
      "problem",
      {"bucket", "map", "width", "height", "start column", "start row", "goal column", "goal row", "optimal length"}};
  return kFormat;
}

std::vector<GridProblem> readProblemsFrom(LineReader reader, int width, int height) {
  std::vector<GridProblem> problems;
  std::vector<Word> words;
  while (nextWords(reader, words)) {
    if (words[0].text == "version") continue;
    const LineFields fields(reader, words, problemFormat());
    const auto whole = [&](std::size_t field, int end) {
      const double value = fields.numberWithin(field, 0.0, end - 1);
      if (value != std::floor(value))
        throw fields.problemAt(field, "problem", Message("movingai.no-cell", "{} is no cell", words[field].text));
      return static_cast<int>(value);
    };
    if (fields.number(2) != width || fields.number(3) != height)
      throw fields.problemAt(2, "problem",
                             Message("movingai.other-map", "is of a map of {} x {} cells, not of {} x {}",
                                     words[2].text, words[3].text, width, height));
    GridProblem problem{whole(4, width), whole(5, height), whole(6, width), whole(7, height)};
    problem.optimal_length = fields.number(8);
    problem.line = reader.lineNumber();
    problems.push_back(problem);
  }
  return problems;
}

}  // namespace

OctileMap readOctileMap(const std::filesystem::path& file, double cell_m) {
  return readMapFrom(LineReader(file), cell_m);
}

OctileMap parseOctileMap(std::string_view bytes, const std::string& name, double cell_m) {
  return readMapFrom(LineReader::fromBytes(bytes, name), cell_m);
}

std::vector<GridProblem> readGridProblems(const std::filesystem::path& file, int width, int height) {
  return readProblemsFrom(LineReader(file), width, height);
}

std::vector<GridProblem> parseGridProblems(std::string_view bytes, const std::string& name, int width, int height) {
  return readProblemsFrom(LineReader::fromBytes(bytes, name), width, height);
}

}  // namespace swiftlet::interfaces
