#include "perception/slam2d/loop_consensus.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "optimization/pose_graph_2d.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

/// A closure whose error after optimization is larger is rejected.
constexpr double kMaxEdgeSigmas = 4.0;

/// At least this many rejected closures must agree to overrule the graph.
constexpr int kLeastConsensus = 3;

/// Greatest squared, normalized error of a closure that fits.
constexpr double kMostError = kMaxEdgeSigmas * kMaxEdgeSigmas;

/// The optimization problem of a graph with new closures. Keeps track of its edges while some are removed.
struct Trial {
  optimization::PoseGraph2D problem;
  std::vector<int> edge_of;  ///< Index of each edge: first the graph's edges, then the new closures.
  int first_new = 0;

  Trial(const SlamGraph& graph, const std::vector<FoundLoop>& loops)
      : problem(toPoseGraph(graph)), first_new(static_cast<int>(graph.edges.size())) {
    for (const FoundLoop& loop : loops) problem.edges.push_back(toPoseEdge(loop.edge));
    edge_of.resize(problem.edges.size());
    std::iota(edge_of.begin(), edge_of.end(), 0);
  }

  void remove(std::size_t i, std::vector<int>& removed) {
    removed.push_back(edge_of[i]);
    problem.edges.erase(problem.edges.begin() + static_cast<std::ptrdiff_t>(i));
    edge_of.erase(edge_of.begin() + static_cast<std::ptrdiff_t>(i));
  }

  LoopConsensus consensus(std::vector<Pose2> poses, const std::vector<FoundLoop>& loops,
                          std::vector<int> removed) const {
    LoopConsensus result;
    result.T_map_key = std::move(poses);
    std::sort(removed.begin(), removed.end());
    for (int i = 0; i < static_cast<int>(loops.size()); ++i) {
      const bool out = std::binary_search(removed.begin(), removed.end(), first_new + i);
      (out ? result.refused : result.accepted).push_back(loops[static_cast<std::size_t>(i)]);
    }
    result.rejected_edges.assign(removed.begin(), std::lower_bound(removed.begin(), removed.end(), first_new));
    return result;
  }
};

}  // namespace

LoopConsensus optimizeWithRejection(const SlamGraph& graph, const std::vector<FoundLoop>& loops,
                                    const Slam2dConfig& config) {
  Trial trial(graph, loops);
  std::vector<int> removed;
  while (true) {
    optimization::PoseGraphSolution<common::Pose2> solution = optimization::optimize(trial.problem, config.graph);
    const std::vector<double>& errors = solution.squared_errors;
    std::optional<std::size_t> worst;
    for (std::size_t i = 0; i < errors.size(); ++i)
      if (trial.problem.edges[i].robust && errors[i] > kMostError && (!worst || errors[i] > errors[*worst])) worst = i;
    if (!worst) return trial.consensus(std::move(solution.poses), loops, std::move(removed));
    trial.remove(*worst, removed);
  }
}

std::optional<LoopConsensus> consensusOfRejected(const SlamGraph& graph, const std::vector<FoundLoop>& rejected,
                                                 const Slam2dConfig& config) {
  if (static_cast<int>(rejected.size()) < kLeastConsensus) return std::nullopt;
  Trial trial(graph, rejected);
  for (std::size_t i = 0; i < trial.problem.edges.size(); ++i) {
    optimization::PoseEdge2D& edge = trial.problem.edges[i];
    edge.robust = static_cast<int>(i) < trial.first_new && (edge.robust || areOfTwoPasses(edge.from, edge.to));
  }
  std::vector<int> removed;
  while (true) {
    optimization::PoseGraphSolution<common::Pose2> solution = optimization::optimize(trial.problem, config.graph);
    const std::size_t before = removed.size();
    for (std::size_t i = solution.squared_errors.size(); i-- > 0;)
      if (solution.squared_errors[i] > kMostError &&
          (trial.problem.edges[i].robust || trial.edge_of[i] >= trial.first_new))
        trial.remove(i, removed);
    if (removed.size() > before) continue;
    LoopConsensus consensus = trial.consensus(std::move(solution.poses), rejected, std::move(removed));
    const std::size_t agree = consensus.accepted.size();
    if (static_cast<int>(agree) < kLeastConsensus || agree <= consensus.rejected_edges.size()) return std::nullopt;
    return consensus;
  }
}

}  // namespace swiftlet::perception
