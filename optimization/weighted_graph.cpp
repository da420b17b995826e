#include "optimization/weighted_graph.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <set>
#include <utility>

#include "optimization/chordal_start.hpp"
#include "optimization/edge_innovation.hpp"
#include "optimization/graph_parts.hpp"
#include "optimization/pose_graph_2d.hpp"
#include "optimization/pose_graph_3d.hpp"

namespace swiftlet::optimization {
namespace {

/// Edges of less weight are left out.
constexpr double kLeastWeight = 1e-9;
constexpr int kGroupReach = 10;  ///< Poses.
/// Bounds the time that a group of closures takes.
constexpr std::size_t kLargestGroupErrors = 96;

constexpr int errorSizeOf(const PoseGraph2D&) { return 3; }
constexpr int errorSizeOf(const PoseGraph3D&) { return 6; }

/// Of the edges between two consecutive poses the first is odometry.
template <typename Edges>
std::vector<bool> closuresAmong(const Edges& edges, const std::vector<int>& places) {
  std::vector<bool> closures;
  std::set<int> connected;
  for (const auto& edge : edges) {
    const int from = places[at(edge.from)], to = places[at(edge.to)];
    closures.push_back(std::abs(from - to) != 1 || !connected.insert(std::min(from, to)).second);
  }
  return closures;
}

/// Numbers of edges.
template <typename Edges>
std::vector<std::vector<std::size_t>> groupsAmong(const Edges& edges, const std::vector<bool>& closures,
                                                  const std::vector<int>& places, std::size_t largest) {
  std::vector<std::size_t> numbers;
  std::vector<std::pair<int, int>> ends;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!closures[i]) continue;
    numbers.push_back(i);
    ends.emplace_back(places[at(edges[i].from)], places[at(edges[i].to)]);
  }
  auto groups = closureGroups(ends, largest);
  for (auto& group : groups)
    for (std::size_t& member : group) member = numbers[member];
  return groups;
}

template <typename Graph>
class Weighted final : public WeightedGraph {
 public:
  Weighted(Graph& graph, const std::vector<int>& places)
      : graph_(graph),
        closures_(closuresAmong(graph.edges, places)),
        innovations_(graph.poses.size(), anchorsOf(graph),
                     groupsAmong(graph.edges, closures_, places,
                                 kLargestGroupErrors / static_cast<std::size_t>(errorSizeOf(graph)))) {
    fix(graph_, anchorsOf(graph_));
    for (auto& edge : graph_.edges) edge.robust = false;
  }

  int errorSize() const override { return errorSizeOf(graph_); }
  const std::vector<bool>& closures() const override { return closures_; }

  void optimize(const std::vector<double>& weights, int max_iterations) override {
    Graph part = graph_;
    part.edges.clear();
    for (std::size_t i = 0; i < weights.size(); ++i)
      if (weights[i] > kLeastWeight) {
        part.edges.push_back(graph_.edges[i]);
        part.edges.back().information *= weights[i];
      }
    auto chordal = chordalStart(part);
    if (chi2Of(squaredErrors(part, chordal)) < chi2Of(squaredErrors(part, part.poses))) part.poses = std::move(chordal);
    PoseGraphConfig config;
    config.max_iterations = max_iterations;
    config.relative_decrease = 1e-8;
    config.trust_radius = 1e16;  // Steps of Gauss-Newton: the start is near.
    graph_.poses = optimization::optimize(part, config).poses;
  }

  SquaredInnovations squaredInnovations(const std::vector<bool>& kept) override {
    return innovations_.squared(whitenedEdges(graph_, graph_.poses), kept);
  }
  SquaredInnovations squaredInnovationsOfEach() const override {
    std::vector<std::vector<std::size_t>> each;
    for (std::size_t i = 0; i < closures_.size(); ++i)
      if (closures_[i]) each.push_back({i});
    return EdgeInnovations(graph_.poses.size(), anchorsOf(graph_), std::move(each))
        .squared(whitenedEdges(graph_, graph_.poses), std::vector<bool>(closures_.size(), true));
  }

 private:
  Graph& graph_;
  std::vector<bool> closures_;
  EdgeInnovations innovations_;
};

}  // namespace

std::vector<std::vector<std::size_t>> closureGroups(const std::vector<std::pair<int, int>>& ends, std::size_t largest) {
  const auto stretch = [&](std::size_t i) { return std::minmax(ends[i].first, ends[i].second); };
  std::vector<std::size_t> order(ends.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return stretch(a) < stretch(b); });

  std::vector<std::vector<std::size_t>> groups;
  std::vector<std::size_t> group_of(ends.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    const auto [first, second] = stretch(order[n]);
    std::size_t group = groups.size();
    for (std::size_t m = n; m-- > 0 && first - stretch(order[m]).first <= kGroupReach;) {
      const bool near = std::abs(second - stretch(order[m]).second) <= kGroupReach;
      if (!near || groups[group_of[order[m]]].size() >= largest) continue;
      group = group_of[order[m]];
      break;
    }
    if (group == groups.size()) groups.emplace_back();
    groups[group].push_back(order[n]);
    group_of[order[n]] = group;
  }
  return groups;
}

std::unique_ptr<WeightedGraph> weighted(PoseGraph2D& graph, const std::vector<int>& places) {
  return std::make_unique<Weighted<PoseGraph2D>>(graph, places);
}
std::unique_ptr<WeightedGraph> weighted(PoseGraph3D& graph, const std::vector<int>& places) {
  return std::make_unique<Weighted<PoseGraph3D>>(graph, places);
}

}  // namespace swiftlet::optimization
