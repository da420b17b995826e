#include "apps/plan_problems.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/map_kind.hpp"
#include "apps/show.hpp"
#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "common/random.hpp"
#include "flight/wall_clock.hpp"
#include "interfaces/files/movingai.hpp"
#include "interfaces/files/movingai3d.hpp"
#include "interfaces/files/unpacked_stream.hpp"
#include "planning/search/dstar_lite.hpp"
#include "planning/search/voxel_search.hpp"

namespace swiftlet::apps {
namespace {

/// The lengths of the files are rounded to 5 to 8 digits.
constexpr double kRoundedTo = 1e-4;
constexpr std::size_t kListed = 10;

struct OddProblem {
  int line = 0;
  double length = 0.0;  ///< In cells; 0: no path.
  double optimal_length = 0.0;
};

struct ProblemsReport {
  std::size_t problems = 0;
  std::vector<OddProblem> odd;
  double seconds = 0.0;
  std::size_t nodes = 0;
};

/// Of a chain of neighbours, in cells.
double octileLength(const planning::CellPath& cells) {
  std::size_t diagonal = 0;
  for (std::size_t i = 1; i < cells.size(); ++i)
    diagonal += cells[i].x != cells[i - 1].x && cells[i].y != cells[i - 1].y ? 1 : 0;
  return static_cast<double>(cells.size() - 1 - diagonal) + std::numbers::sqrt2 * static_cast<double>(diagonal);
}

/// Cells alone, all of equal cost: a hull that is smaller than a cell.
planning::CostMap plainMap(const common::OccupancyGrid& grid) {
  planning::CostMap::Config plain;
  plain.comfort_weight = 0.0;
  planning::CostMap map(plain, grid.resolution_m());
  map.update(grid, {0.1 * grid.resolution_m(), 0.0});
  return map;
}

/// So many of them, drawn by the seed, in their order; all for 0.
template <typename Problem>
std::vector<Problem> drawn(std::vector<Problem> problems, const PlanProblemsOptions& options) {
  const auto wanted = static_cast<std::size_t>(options.drawn);
  if (wanted == 0 || wanted >= problems.size()) return problems;
  common::RandomStream random(static_cast<std::uint64_t>(options.seed), "plan problems");
  std::vector<Problem> taken;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const std::size_t left = problems.size() - i;
    if (random.uniform() * static_cast<double>(left) < static_cast<double>(wanted - taken.size()))
      taken.push_back(problems[i]);
  }
  return taken;
}

/// A problem of no length is from a cell to itself.
void compare(ProblemsReport& report, int line, bool found, double length, double optimal_length) {
  if (!found || std::abs(length - optimal_length) > kRoundedTo * std::max(1.0, optimal_length))
    report.odd.push_back({line, length, optimal_length});
}

ProblemsReport solve(const interfaces::VoxelListing& map, const std::vector<interfaces::VoxelProblem>& problems) {
  planning::VoxelGrid grid(map.size);
  for (const common::VoxelIndex& voxel : map.blocked) grid.block(voxel);
  planning::VoxelSearch search(grid);
  ProblemsReport report;
  report.problems = problems.size();
  const auto begin = flight::Clock::now();
  for (const interfaces::VoxelProblem& problem : problems) {
    const auto path = search.plan(problem.start, problem.goal);
    report.nodes += search.expansions();
    compare(report, problem.line, path.has_value(), path ? path->length : 0.0, problem.optimal_length);
  }
  report.seconds = flight::secondsSince(begin);
  return report;
}

ProblemsReport solve(const interfaces::OctileMap& map, const std::vector<interfaces::GridProblem>& problems) {
  const planning::CostMap costs = plainMap(map.grid);
  planning::DStarLite planner(planning::kOctileScale);
  ProblemsReport report;
  report.problems = problems.size();
  const auto begin = flight::Clock::now();
  for (const interfaces::GridProblem& problem : problems) {
    const auto plan = planner.planCells(costs, costs.centerOf(map.cellAt(problem.start_column, problem.start_row)),
                                        costs.centerOf(map.cellAt(problem.goal_column, problem.goal_row)));
    report.nodes += static_cast<std::size_t>(planner.expansions());
    const double length = plan && plan->escape_cells == 0 ? octileLength(plan->cells) : 0.0;
    compare(report, problem.line, plan.has_value(), length, problem.optimal_length);
  }
  report.seconds = flight::secondsSince(begin);
  return report;
}

std::string problemsJson(const ProblemsReport& report, const PlanProblemsOptions& options) {
  nlohmann::json json{
      {"map", options.map},        {"problems", report.problems}, {"optimal", report.problems - report.odd.size()},
      {"seconds", report.seconds}, {"nodes", report.nodes},       {"odd", nlohmann::json::array()}};
  for (const OddProblem& odd : report.odd)
    json["odd"].push_back({{"line", odd.line}, {"length", odd.length}, {"optimal_length", odd.optimal_length}});
  return json.dump(2) + "\n";
}

std::string problemsText(const ProblemsReport& report, const PlanProblemsOptions& options) {
  std::string text = fmt::format("{} of {} lengths are the optimal ones; {:.2f} s, {} nodes\n",
                                 report.problems - report.odd.size(), report.problems, report.seconds, report.nodes);
  for (std::size_t i = 0; i < std::min(report.odd.size(), kListed); ++i) {
    const OddProblem& odd = report.odd[i];
    text += fmt::format("  {}:{}: {}, optimal {:.5f}\n", options.problems, odd.line,
                        odd.length > 0.0 ? fmt::format("{:.5f}", odd.length) : "no path", odd.optimal_length);
  }
  if (report.odd.size() > kListed) text += fmt::format("  and {} more\n", report.odd.size() - kListed);
  return text;
}

}  // namespace

namespace {

template <typename Problem>
std::vector<Problem> chosen(std::vector<Problem> problems, const PlanProblemsOptions& options) {
  if (problems.empty())
    throw common::InputError({options.problems}, "--problems", common::Message("plan.no-problems", "has no problem"));
  return drawn(std::move(problems), options);
}

ProblemsReport solved(const PlanProblemsOptions& options) {
  if (common::endingOf(interfaces::unpackedName(options.map)) == ".3dmap") {
    const interfaces::VoxelListing map = interfaces::readVoxelListing(options.map);
    return solve(map, chosen(interfaces::readVoxelProblems(options.problems, map.size), options));
  }
  if (mapKindOf(options.map) != MapKind::kGrid)
    throw common::InputError({options.map}, "",
                             common::Message("plan.no-grid", "is no .map or .3dmap of the Moving AI benchmarks"));
  const interfaces::OctileMap map = interfaces::readOctileMap(options.map, 1.0);
  return solve(map, chosen(interfaces::readGridProblems(options.problems, map.width, map.height), options));
}

}  // namespace

int planProblems(const PlanProblemsOptions& options) {
  const ProblemsReport report = solved(options);
  if (options.json)
    showJson(problemsJson(report, options));
  else
    show(problemsText(report, options));
  return report.odd.empty() ? kDone : kFailed;
}

}  // namespace swiftlet::apps
