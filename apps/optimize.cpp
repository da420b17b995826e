// swiftlet optimize: the poses that best satisfy any pose graph.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <system_error>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/recorded_log.hpp"
#include "apps/required.hpp"
#include "apps/results_folder.hpp"
#include "apps/show.hpp"
#include "apps/wall_clock.hpp"
#include "common/error.hpp"
#include "common/table.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/g2o.hpp"
#include "optimization/best_start.hpp"
#include "optimization/graph_parts.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using interfaces::G2oGraph2D;
using interfaces::G2oGraph3D;

struct OptimizeOptions {
  std::string graph;
  std::string out;
  int max_iterations = 100;
  bool ignore_cross_terms = false;
  bool json = false;
};

/// The file of the figures marks the folder as made by this command. A comment in the graph would not be readable for
/// every program.
const ResultsKind kOptimizeResults{
    "optimized graph", "optimized.json", "\"chi2_final\"", {"optimized.json", "graph.g2o"}};

/// The report about an optimized graph.
struct Report {
  std::size_t vertices = 0;
  std::size_t edges = 0;
  std::size_t loose_parts = 0;  ///< Number of parts that no edges connect to a fixed vertex.
  int dimension = 0;
  double chi2_initial = 0.0;
  double chi2_final = 0.0;
  const char* start = "";
  int iterations = 0;  ///< Iterations of all starts together.
  double seconds = 0.0;
  bool converged = false;
  std::string written;
};

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

template <typename Graph>
Report optimizeInPlace(Graph& file, const OptimizeOptions& options) {
  const auto begin = Clock::now();
  auto graph = poseGraph(file);
  if (file.poses.empty()) graph.poses = chainedPoses(graph);
  optimization::BestStartConfig config;
  config.max_iterations = options.max_iterations;
  const std::size_t fixed = std::set<int>(file.fixed.begin(), file.fixed.end()).size();
  const std::size_t loose_parts = anchorsOf(graph).size() - std::max<std::size_t>(1, fixed);
  auto solution = optimizeFromBestStart(std::move(graph), config);
  file.poses = std::move(solution.poses);

  Report report;
  report.vertices = file.ids.size();
  report.edges = file.edges.size();
  report.loose_parts = loose_parts;
  report.dimension = Graph::kErrors == 3 ? 2 : 3;
  report.chi2_initial = solution.chi2_guess;
  report.chi2_final = solution.chi2;
  report.start = toString(solution.start);
  report.iterations = solution.iterations;
  report.converged = solution.converged;
  report.seconds = secondsSince(begin);
  return report;
}

void refuseTheGraphItself(const OptimizeOptions& options) {
  const fs::path target = fs::path(options.out) / "graph.g2o";
  std::error_code ignored;
  if (fs::equivalent(target, options.graph, ignored))
    throw common::InputError(
        common::Problem{{target.string()}, "--out", "is the graph to be optimized itself", "give another folder"});
}

std::string jsonOf(const Report& report, const interfaces::G2oFile& file, const OptimizeOptions& options) {
  nlohmann::json json{{"graph", options.graph},
                      {"vertices", report.vertices},
                      {"edges", report.edges},
                      {"dimension", report.dimension},
                      {"chi2_initial", report.chi2_initial},
                      {"chi2_final", report.chi2_final},
                      {"start", report.start},
                      {"iterations", report.iterations},
                      {"loose_parts", report.loose_parts},
                      {"seconds", report.seconds},
                      {"converged", report.converged},
                      {"warnings", file.warnings},
                      {"indefinite_edges", file.indefinite_edges}};
  if (!report.written.empty()) json["written"] = report.written;
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string textOf(const Report& report, const OptimizeOptions& options) {
  const common::Table table{"",
                            {"graph", "vertices", "edges", "dimension", "chi2 initial", "chi2 final", "start",
                             "converged", "iterations in all", "seconds"},
                            {{{fs::path(options.graph).filename().string()},
                              {fmt::format("{}", report.vertices)},
                              {fmt::format("{}", report.edges)},
                              {fmt::format("{}", report.dimension)},
                              {fmt::format("{:.6g}", report.chi2_initial)},
                              {fmt::format("{:.8g}", report.chi2_final)},
                              {report.start},
                              {report.converged ? "yes" : "no"},
                              {fmt::format("{}", report.iterations)},
                              {fmt::format("{:.2f}", report.seconds)}}}};
  std::string text = toText(table);
  if (!report.converged) text += "it did not converge; more --max-iterations may help\n";
  if (!report.written.empty()) text += fmt::format("written {}\n", report.written);
  return text;
}

void write(ResultsFolder& folder, const interfaces::G2oFile& file, const OptimizeOptions& options, Report& report) {
  const std::string graph = std::visit([](const auto& g) { return toG2o(g); }, file.graph);
  report.written = (folder.path() / "graph.g2o").string();
  required(interfaces::writeAtomically(folder.unfinished() / "graph.g2o", graph));
  required(interfaces::writeAtomically(folder.unfinished() / "optimized.json", jsonOf(report, file, options) + "\n"));
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
  Report report = std::visit([&](auto& graph) { return optimizeInPlace(graph, options); }, file.graph);
  if (!std::isfinite(report.chi2_final)) {
    showError(
        fmt::format("{}: chi2 is {}: its errors or its information are too large for numbers; nothing is written\n",
                    options.graph, report.chi2_final));
    return kFailed;
  }
  if (report.loose_parts > 0)
    fmt::print(stderr, "note: {} not connected to the fixed vertex, so its place relative to that is arbitrary\n",
               plural(report.loose_parts, "part of the graph is", "parts of the graph are"));
  if (folder) write(*folder, file, options, report);
  if (options.json)
    showJson(jsonOf(report, file, options) + "\n");
  else
    show(textOf(report, options));
  return report.converged ? kDone : kFailed;
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
  command.flag("--json", options->json, "Print the result as JSON, nothing else.");
  command.footer(
      "chi2 is the sum of e' Omega e over the edges, with g2o's error e and no factor of 1/2; `iterations in all` are\n"
      "those of all starts that were tried.\n\nExample: swiftlet optimize sphere2500.g2o.xz --out optimized");
  command.runs([options] { return optimizeGraph(*options); });
}

}  // namespace swiftlet::apps
