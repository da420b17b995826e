// swiftlet optimize: the poses that best satisfy any pose graph.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "apps/command.hpp"
#include "apps/optimize_report.hpp"
#include "apps/recorded_log.hpp"
#include "apps/results_folder.hpp"
#include "apps/show.hpp"
#include "common/error.hpp"
#include "flight/wall_clock.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/g2o.hpp"
#include "interfaces/files/required.hpp"
#include "optimization/best_start.hpp"
#include "optimization/closure_selection.hpp"
#include "optimization/graph_parts.hpp"
#include "optimization/weighted_graph.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using interfaces::G2oGraph2D;
using interfaces::G2oGraph3D;
using optimization::ClosureSelection;

struct OptimizeOptions {
  std::string graph;
  std::string out;
  int max_iterations = 100;
  bool ignore_cross_terms = false;
  bool robust = false;
  bool json = false;
};

/// The file of the figures marks the folder as made by this command. A comment in the graph would not be readable for
/// every program.
const ResultsKind kOptimizeResults{
    "optimized graph", "optimized.json", "\"chi2_final\"", {"optimized.json", "graph.g2o"}};

/// The file's information belongs to the error expressed in the frame where the measurement ends (g2o's), Swiftlet's to
/// that in the frame where it starts. chi2 is the same.
optimization::PoseGraph2D poseGraph(const G2oGraph2D& file) {
  optimization::PoseGraph2D graph;
  graph.poses = file.poses;
  graph.poses.resize(file.ids.size());
  for (const auto& edge : file.edges)
    graph.edges.push_back(
        {edge.from, edge.to, edge.T_from_to, common::turned(edge.information, edge.T_from_to.yaw_rad), false});
  if (!file.fixed.empty()) graph.fixed = file.fixed.front();
  graph.also_fixed = file.fixed;
  return graph;
}

optimization::PoseGraph3D poseGraph(const G2oGraph3D& file) {
  optimization::PoseGraph3D graph;
  graph.poses = file.poses;
  graph.poses.resize(file.ids.size());
  for (const auto& edge : file.edges) {
    optimization::PoseEdge3D added;
    added.from = edge.from;
    added.to = edge.to;
    added.T_from_to = edge.T_from_to;
    added.information = edge.information;
    graph.edges.push_back(added);
  }
  if (!file.fixed.empty()) graph.fixed = file.fixed;
  return graph;
}

/// The places of the vertices along the trajectory: the order of their ids.
std::vector<int> placesByIds(const std::vector<std::int64_t>& ids) {
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  std::vector<int> places(ids.size());
  for (std::size_t i = 0; i < order.size(); ++i) places[order[i]] = static_cast<int>(i);
  return places;
}

/// The refused closures, worst first.
template <typename Graph>
std::vector<ContradictedEdge> refusedEdges(const Graph& file, const ClosureSelection& selection) {
  std::vector<ContradictedEdge> refused;
  for (std::size_t i = 0; i < file.edges.size(); ++i)
    if (!selection.kept[i])
      refused.push_back({file.ids[static_cast<std::size_t>(file.edges[i].from)],
                         file.ids[static_cast<std::size_t>(file.edges[i].to)], selection.sigmas[i]});
  std::stable_sort(refused.begin(), refused.end(), [](const auto& a, const auto& b) { return a.sigmas > b.sigmas; });
  return refused;
}

template <typename Edges>
void eraseRefused(Edges& edges, const std::vector<bool>& kept) {
  std::size_t left = 0;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) edges[left++] = edges[i];
  edges.resize(left);
}

template <typename Graph, typename PoseGraph>
void reportSelection(OptimizeReport& report, const Graph& file, const PoseGraph& graph,
                     const ClosureSelection& selection) {
  report.closures = selection.closures;
  report.variance_factor = selection.variance_factor;
  report.contradicted = refusedEdges(file, selection);
  report.degrees_of_freedom =
      Graph::kErrors * (static_cast<std::int64_t>(graph.edges.size() + anchorsOf(graph).size()) -
                        static_cast<std::int64_t>(graph.poses.size()));
}

/// Chooses among the closures first; those that are refused are taken out of the file's edges.
template <typename Graph, typename PoseGraph>
void optimizeRobustly(Graph& file, PoseGraph graph, const OptimizeOptions& options, OptimizeReport& report) {
  report.chi2_initial = optimization::chi2Of(squaredErrors(graph, graph.poses));
  const auto selection = selectClosures(*weighted(graph, placesByIds(file.ids)));
  eraseRefused(graph.edges, selection.kept);
  optimization::PoseGraphConfig config;
  config.max_iterations = options.max_iterations;
  config.relative_decrease = optimization::BestStartConfig{}.relative_decrease;
  auto solution = optimize(graph, config);
  reportSelection(report, file, graph, selection);
  eraseRefused(file.edges, selection.kept);
  file.poses = std::move(solution.poses);
  report.chi2_final = optimization::chi2Of(solution.squared_errors);
  report.start = "robust";
  report.iterations = selection.iterations + solution.iterations;
  report.verdict = !selection.sure      ? GraphVerdict::kCannotTell
                   : solution.converged ? GraphVerdict::kConverged
                                        : GraphVerdict::kNotConverged;
}

template <typename Graph, typename PoseGraph>
void optimizeAll(Graph& file, PoseGraph graph, const OptimizeOptions& options, OptimizeReport& report) {
  optimization::BestStartConfig config;
  config.max_iterations = options.max_iterations;
  const auto solution = optimizeFromBestStart(graph, config);
  report.chi2_initial = solution.chi2_guess;
  report.chi2_final = solution.chi2;
  report.start = toString(solution.start);
  report.iterations = solution.iterations;
  report.verdict = solution.converged ? GraphVerdict::kConverged : GraphVerdict::kNotConverged;
  file.poses = solution.poses;
  if (!solution.converged || !std::isfinite(solution.chi2)) return;
  graph.poses = solution.poses;
  const auto selection = contradictedClosures(*weighted(graph, placesByIds(file.ids)));
  reportSelection(report, file, graph, selection);
  if (selection.refused > 0) report.verdict = GraphVerdict::kContradictory;
}

template <typename Graph>
OptimizeReport optimizeInPlace(Graph& file, const OptimizeOptions& options) {
  const auto begin = flight::Clock::now();
  auto graph = poseGraph(file);
  if (file.poses.empty()) graph.poses = chainedPoses(graph);
  const std::size_t fixed = std::set<int>(file.fixed.begin(), file.fixed.end()).size();
  OptimizeReport report;
  report.graph = options.graph;
  report.robust = options.robust;
  report.vertices = file.ids.size();
  report.edges = file.edges.size();
  report.loose_parts = anchorsOf(graph).size() - std::max<std::size_t>(1, fixed);
  report.dimension = Graph::kErrors == 3 ? 2 : 3;
  if (options.robust)
    optimizeRobustly(file, std::move(graph), options, report);
  else
    optimizeAll(file, std::move(graph), options, report);
  report.seconds = flight::secondsSince(begin);
  return report;
}

void refuseTheGraphItself(const OptimizeOptions& options) {
  const fs::path target = fs::path(options.out) / "graph.g2o";
  std::error_code ignored;
  if (fs::equivalent(target, options.graph, ignored))
    throw common::InputError({target.string()}, "--out",
                             common::Message("optimize.own-graph", "is the graph to be optimized itself"),
                             "give another folder");
}

void write(ResultsFolder& folder, const interfaces::G2oFile& file, OptimizeReport& report) {
  const std::string graph = std::visit([](const auto& g) { return toG2o(g); }, file.graph);
  report.written = (folder.path() / "graph.g2o").string();
  required(interfaces::writeAtomically(folder.unfinished() / "graph.g2o", graph));
  required(interfaces::writeAtomically(folder.unfinished() / "optimized.json", jsonOf(report, file) + "\n"));
  folder.publish();
}

int optimizeGraph(const OptimizeOptions& options) {
  interfaces::G2oFile file = interfaces::readG2o(fs::path(options.graph), {options.ignore_cross_terms});
  for (const std::string& warning : file.warnings) showError(warning + "\n");
  if (file.indefinite_edges > 0)
    showError(fmt::format("note: the information of {} is not positive definite: its diagonal alone is used\n",
                          plural(file.indefinite_edges, "edge", "edges")));
  std::optional<ResultsFolder> folder;
  if (!options.out.empty()) {
    refuseTheGraphItself(options);
    folder.emplace(options.out, kOptimizeResults);
  }
  OptimizeReport report = std::visit([&](auto& graph) { return optimizeInPlace(graph, options); }, file.graph);
  if (!std::isfinite(report.chi2_final)) {
    showError(
        fmt::format("{}: chi2 is {}: its errors or its information are too large for numbers; nothing is written\n",
                    options.graph, report.chi2_final));
    return kFailed;
  }
  if (report.loose_parts > 0)
    fmt::print(stderr, "note: {} not connected to the fixed vertex, so its place relative to that is arbitrary\n",
               plural(report.loose_parts, "part of the graph is", "parts of the graph are"));
  if (folder) write(*folder, file, report);
  if (options.json)
    showJson(jsonOf(report, file) + "\n");
  else
    show(textOf(report));
  return report.verdict == GraphVerdict::kConverged ? kDone : kFailed;
}

}  // namespace

void addOptimize(Command& program) {
  auto options = std::make_shared<OptimizeOptions>();
  Command command = program.command("optimize", "Find the poses that best satisfy a pose graph (g2o).");
  command.argument("graph", options->graph,
                   "Graph in the plane or in space, of g2o (SE2 or SE3:QUAT) or TORO (2 or 3), plain or compressed by "
                   "gzip, bzip2 or xz. Without vertices, the guess follows from the shortest chains of edges.");
  command.option("--out", options->out,
                 "Folder for the optimized graph, graph.g2o, and its figures, optimized.json; new, empty or with older "
                 "ones.");
  command.option("--max-iterations", options->max_iterations, {1, 1000},
                 "Iterations of each start that is tried, at most.");
  command.flag(
      "--ignore-cross-terms", options->ignore_cross_terms,
      "Where the information of an edge is not positive definite, use its diagonal alone. Without this, such a "
      "graph is refused.");
  command.flag("--robust", options->robust,
               "Refuse loop closures that the others contradict, by graduated non-convexity and by their innovations. "
               "Edges of consecutive vertices are odometry, and are kept.");
  command.flag("--json", options->json, "Print the result as JSON, nothing else.");
  command.footer(
      "chi2 is the sum of e' Omega e over the edges, with g2o's error e and no factor of 1/2; `iterations in all` are\n"
      "those of all starts that were tried. Where closures contradict the other edges by far, it says "
      "`contradictory`;\n"
      "--robust says `cannot tell` where those that it refuses may be the right ones. Neither counts as converged.\n\n"
      "Example: swiftlet optimize sphere2500.g2o.xz --out optimized");
  command.runs([options] { return optimizeGraph(*options); });
}

}  // namespace swiftlet::apps
