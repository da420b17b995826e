#include "perception/slam2d/slam_task.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/check.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

/// A shift of less than this share of a cell does not show in the grid.
constexpr double kVisibleCells = 0.25;

double greatestShift(const SlamGraph& graph, const std::vector<Pose2>& poses) {
  double greatest = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose2 step = between(graph.keys[i].T_map_body, poses[i]);
    // A rotation moves what is seen some metres away.
    greatest = std::max(greatest, step.position_m().norm() + 3.0 * std::abs(step.yaw_rad));
  }
  return greatest;
}

struct Settled {
  std::vector<Pose2> T_map_key;
  std::vector<FoundLoop> accepted;
  std::vector<int> taken_back;  ///< Edges of the graph, ascending.
};

/// Optimizes, and takes back the closure that fits worst, new or old, until all that are left fit.
Settled settle(const SlamGraph& graph, const std::vector<FoundLoop>& loops, const Slam2dConfig& config) {
  optimization::PoseGraph2D problem = toPoseGraph(graph);
  std::vector<int> edge_of(problem.edges.size());  // Of the graph; after these, the new ones.
  std::iota(edge_of.begin(), edge_of.end(), 0);
  const int first_new = static_cast<int>(edge_of.size());
  for (const FoundLoop& loop : loops) {
    edge_of.push_back(static_cast<int>(edge_of.size()));
    problem.edges.push_back(toPoseEdge(loop.edge));
  }
  std::vector<char> refused(loops.size(), 0);
  Settled settled;
  const double most = config.loops.max_edge_sigmas * config.loops.max_edge_sigmas;
  while (true) {
    optimization::PoseGraph2DSolution solution = optimization::optimize(problem, config.graph);
    std::ptrdiff_t worst = -1;
    for (std::size_t i = 0; i < problem.edges.size(); ++i)
      if (problem.edges[i].robust && solution.squared_errors[i] > most &&
          (worst < 0 || solution.squared_errors[i] > solution.squared_errors[static_cast<std::size_t>(worst)]))
        worst = static_cast<std::ptrdiff_t>(i);
    if (worst < 0) {
      settled.T_map_key = std::move(solution.poses);
      break;
    }
    const int edge = edge_of[static_cast<std::size_t>(worst)];
    if (edge < first_new)
      settled.taken_back.push_back(edge);
    else
      refused[static_cast<std::size_t>(edge - first_new)] = 1;
    problem.edges.erase(problem.edges.begin() + worst);
    edge_of.erase(edge_of.begin() + worst);
  }
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (refused[i] == 0) settled.accepted.push_back(loops[i]);
  std::sort(settled.taken_back.begin(), settled.taken_back.end());
  return settled;
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
  if (!loops.empty() || in.is_last) {
    Settled settled = settle(in.graph, loops, in.config);
    // What changes nothing is not worth a jump of the map.
    if (in.is_last || !settled.accepted.empty() || !settled.taken_back.empty())
      out->T_map_key = std::move(settled.T_map_key);
    out->taken_back = std::move(settled.taken_back);
    for (const FoundLoop& loop : settled.accepted) {
      out->closures.push_back(loop.edge);
      result.accepted.push_back({loop.edge.from, loop.edge.to, loop.edge.T_from_to, loop.quality, loop.shift_m});
    }
  }
  if (in.config.live_map && !out->T_map_key.empty() &&
      greatestShift(in.graph, out->T_map_key) > kVisibleCells * in.config.grid.resolution_m) {
    SlamGraph moved = in.graph;
    for (std::size_t i = 0; i < moved.keys.size(); ++i) moved.keys[i].T_map_body = out->T_map_key[i];
    out->map = drawMap(moved, in.config.grid).snapshot();  // Its tiles are cloned before anybody writes.
  }
  result.data = std::move(out);
  return result;
}

}  // namespace swiftlet::perception
