#include "perception/slam2d/slam_task.hpp"

#include <algorithm>
#include <cmath>

#include "common/check.hpp"
#include "perception/slam2d/refinement.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

/// A shift of less than this share of a cell does not show in the grid.
constexpr double kVisibleCells = 0.25;
constexpr int kRefinements = 2;

double greatestShift(const SlamGraph& graph, const std::vector<Pose2>& poses) {
  double greatest = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose2 step = between(graph.keys[i].T_map_body, poses[i]);
    // A rotation moves what is seen some metres away.
    greatest = std::max(greatest, step.position_m().norm() + 3.0 * std::abs(step.yaw_rad));
  }
  return greatest;
}

/// Optimizes, and takes the closure back that fits worst, until all that are left fit.
std::vector<Pose2> optimized(const SlamGraph& graph, std::vector<FoundLoop>& loops, const Slam2dConfig& config) {
  while (!loops.empty()) {
    SlamGraph closed = graph;
    for (const FoundLoop& loop : loops) closed.add(loop.edge);
    const optimization::PoseGraph2DSolution solution = optimization::optimize(toPoseGraph(closed), config.graph);
    const std::size_t first = graph.edges.size();
    const auto worst = std::max_element(solution.squared_errors.begin() + static_cast<std::ptrdiff_t>(first),
                                        solution.squared_errors.end());
    if (*worst <= config.loops.max_edge_sigmas * config.loops.max_edge_sigmas) return solution.poses;
    loops.erase(loops.begin() + (worst - solution.squared_errors.begin() - static_cast<std::ptrdiff_t>(first)));
  }
  return {};
}

/// Moves the key scans to where they fit best.
void relax(SlamGraph& graph, const Slam2dConfig& config) {
  const optimization::PoseGraph2DSolution solution = optimization::optimize(toPoseGraph(graph), config.graph);
  for (std::size_t i = 0; i < graph.keys.size(); ++i) graph.keys[i].T_map_body = solution.poses[i];
}

/// Relaxed, matched across its passes and relaxed again; twice, since the first time brings passes closer. Returns what
/// the last time tied.
std::vector<SlamEdge> refine(SlamGraph& graph, const Slam2dConfig& config) {
  relax(graph, config);
  const std::size_t edges = graph.edges.size();
  SlamGraph tied;
  for (int i = 0; i < kRefinements; ++i) {
    tied = graph;
    for (const FoundLoop& loop : matchPasses(graph, config)) tied.add(loop.edge);
    relax(tied, config);
    for (std::size_t k = 0; k < graph.keys.size(); ++k) graph.keys[k].T_map_body = tied.keys[k].T_map_body;
  }
  return {tied.edges.begin() + static_cast<std::ptrdiff_t>(edges), tied.edges.end()};
}

}  // namespace

SlamResult run(const SlamTask& task) {
  SWIFTLET_CHECK(task.data != nullptr);
  const SlamTask::Data& in = *task.data;
  auto out = std::make_shared<SlamResult::Data>();
  out->id = in.id;
  SlamResult result;
  std::vector<FoundLoop> loops;
  for (const LoopCandidate& candidate : in.candidates)
    if (const auto found = searchLoop(in.graph, in.query, candidate, in.config)) loops.push_back(*found);
  out->T_map_key = optimized(in.graph, loops, in.config);
  if (in.is_last) {
    SlamGraph graph = in.graph;
    out->closures = refine(graph, in.config);
    for (const KeyScan& key : graph.keys) out->T_map_key.push_back(key.T_map_body);
  }
  for (const FoundLoop& loop : loops) {
    out->closures.push_back(loop.edge);
    result.accepted.push_back({loop.edge.from, loop.edge.to, loop.edge.T_from_to, loop.quality, loop.shift_m});
  }
  if (!out->T_map_key.empty() &&
      greatestShift(in.graph, out->T_map_key) > kVisibleCells * in.config.grid.resolution_m) {
    SlamGraph moved = in.graph;
    for (std::size_t i = 0; i < moved.keys.size(); ++i) moved.keys[i].T_map_body = out->T_map_key[i];
    out->map = drawMap(moved, in.config.grid).snapshot();  // Its tiles are cloned before anybody writes.
  }
  result.data = std::move(out);
  return result;
}

}  // namespace swiftlet::perception
