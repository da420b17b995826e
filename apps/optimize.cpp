// swiftlet optimize: the poses that best satisfy a pose graph of other people.
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/numbers.hpp"
#include "apps/required.hpp"
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
  bool json = false;
};

/// What is told of an optimized graph.
struct Report {
  std::size_t vertices = 0;
  std::size_t edges = 0;
  int dimension = 0;
  double chi2_initial = 0.0;
  double chi2_final = 0.0;
  const char* start = "";
  int iterations = 0;
  double seconds = 0.0;
  bool converged = false;
  std::string written;
};

/// The file's information belongs to the error turned into the frame that the measurement leads to (g2o's), ours to
/// that in the frame it starts from; chi2 is the same.
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
  auto solution = optimizeFromBestStart(std::move(graph), config);
  file.poses = std::move(solution.poses);

  Report report;
  report.vertices = file.ids.size();
  report.edges = file.edges.size();
  report.dimension = Graph::kErrors == 3 ? 2 : 3;
  report.chi2_initial = solution.chi2_guess;
  report.chi2_final = solution.chi2;
  report.start = toString(solution.start);
  report.iterations = solution.iterations;
  report.converged = solution.converged;
  report.seconds = secondsSince(begin);
  return report;
}

common::InputError problem(const fs::path& file, const std::string& message, const std::string& hint = "") {
  return common::InputError(common::Problem{{file.string()}, "--out", message, hint});
}

/// The file to be written, its folder made; before the work, so that a mistake is told at once.
fs::path madeTarget(const OptimizeOptions& options) {
  const fs::path folder = options.out;
  fs::path target = folder / "graph.g2o";
  std::error_code failure;
  if (fs::equivalent(target, options.graph, failure))
    throw problem(target, "is the graph to be optimized itself", "give another folder");
  fs::create_directories(folder, failure);
  if (failure) throw problem(folder, failure.message());
  return target;
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
                      {"seconds", report.seconds},
                      {"converged", report.converged},
                      {"warnings", file.warnings}};
  if (!report.written.empty()) json["written"] = report.written;
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string textOf(const Report& report, const OptimizeOptions& options) {
  const common::Table table{
      "",
      {"graph", "vertices", "edges", "dimension", "chi2 initial", "chi2 final", "start", "iterations", "seconds"},
      {{{fs::path(options.graph).filename().string()},
        {fmt::format("{}", report.vertices)},
        {fmt::format("{}", report.edges)},
        {fmt::format("{}", report.dimension)},
        {fmt::format("{:.6g}", report.chi2_initial)},
        {fmt::format("{:.8g}", report.chi2_final)},
        {report.start},
        {fmt::format("{}", report.iterations)},
        {fmt::format("{:.2f}", report.seconds)}}}};
  std::string text = toText(table);
  if (!report.converged) text += "it did not converge; more --max-iterations may help\n";
  if (!report.written.empty()) text += fmt::format("written {}\n", report.written);
  return text;
}

int optimizeGraph(const OptimizeOptions& options) {
  interfaces::G2oFile file = interfaces::readG2o(fs::path(options.graph));
  for (const std::string& warning : file.warnings) fmt::print(stderr, "{}\n", warning);
  const std::optional<fs::path> target = options.out.empty() ? std::nullopt : std::optional(madeTarget(options));
  Report report = std::visit([&](auto& graph) { return optimizeInPlace(graph, options); }, file.graph);
  if (target) {
    const std::string text = std::visit([](const auto& graph) { return toG2o(graph); }, file.graph);
    required(interfaces::writeAtomically(*target, text));
    report.written = target->string();
  }
  fmt::print("{}", options.json ? jsonOf(report, file, options) + "\n" : textOf(report, options));
  return report.converged ? kDone : kFailed;
}

}  // namespace

void addOptimize(CLI::App& program, Run& run) {
  auto options = std::make_shared<OptimizeOptions>();
  auto* command = program.add_subcommand("optimize", "Find the poses that best satisfy a pose graph (g2o).");
  command
      ->add_option(
          "graph", options->graph,
          "Graph in the plane or in space (SE2 or SE3:QUAT), plain or compressed by gzip, bzip2 or xz. Without "
          "vertices, the guess follows from the shortest chains of edges.")
      ->required();
  command->add_option("--out", options->out, "Folder for the optimized graph, graph.g2o; made if it is missing.");
  command->add_option("--max-iterations", options->max_iterations, "Of each start that is tried.")
      ->capture_default_str()
      ->check(numberWithin(1, 1000));
  command->add_flag("--json", options->json, "Print the result as JSON, nothing else.");
  command->footer("Example: swiftlet optimize sphere2500.g2o.xz --out optimized");
  command->callback([&run, options] { run = [options] { return optimizeGraph(*options); }; });
}

}  // namespace swiftlet::apps
