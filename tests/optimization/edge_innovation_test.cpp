// Squared innovations have an oracle: what chi2 changes by when the edge is taken out of the graph or put in.
#include "optimization/edge_innovation.hpp"

#include <gtest/gtest.h>

#include "graphs.hpp"
#include "optimization/graph_parts.hpp"

namespace swiftlet::optimization {
namespace {

using common::RandomStream;
using test::noisyGraph;
using test::sum;

template <typename Kind>
class EdgeInnovation : public testing::Test {};
using Kinds = testing::Types<test::Graph2D, test::Graph3D>;
TYPED_TEST_SUITE(EdgeInnovation, Kinds);

template <typename Graph>
Graph with(const Graph& graph, const std::vector<bool>& kept) {
  Graph part = graph;
  part.edges.clear();
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) part.edges.push_back(graph.edges[i]);
  return part;
}

template <typename Graph>
auto optimum(const Graph& graph, const std::vector<bool>& kept) {
  PoseGraphConfig config;
  config.max_iterations = 100;
  config.relative_decrease = 1e-14;
  return optimize(with(graph, kept), config);
}

template <typename Graph>
double chi2(const Graph& graph, const std::vector<bool>& kept) {
  return sum(optimum(graph, kept).squared_errors);
}

/// By how much chi2 rises when the edge is put into the graph of the others.
template <typename Graph>
double rise(const Graph& graph, std::vector<bool> others, std::size_t edge) {
  others[edge] = false;
  const double without = chi2(graph, others);
  others[edge] = true;
  return chi2(graph, others) - without;
}

TYPED_TEST(EdgeInnovation, IsWhatChi2RisesByWhenTheEdgeIsAdded) {
  RandomStream random(1, "innovation");
  const auto graph = noisyGraph<TypeParam>(16, 1e-3, 1e-3, random);
  std::vector<bool> kept(graph.edges.size(), true);
  kept[17] = kept[18] = false;
  const std::vector<std::vector<std::size_t>> groups{{3}, {15}, {16, 17}, {18, 19, 20}};
  EdgeInnovations innovations(graph.poses.size(), anchorsOf(graph), groups);
  const auto squared = innovations.squared(whitenedEdges(graph, optimum(graph, kept).poses), kept);
  ASSERT_EQ(squared.alone.size(), graph.edges.size());
  EXPECT_EQ(squared.alone[0], 0.0) << "in no group";
  for (const auto& group : groups)
    for (const std::size_t edge : group) {
      auto others = kept;
      for (const std::size_t member : group) others[member] = false;
      const double alone = rise(graph, kept, edge), without_group = rise(graph, others, edge);
      EXPECT_NEAR(squared.alone[edge], alone, 0.02 * alone) << edge;
      EXPECT_NEAR(squared.without_group[edge], without_group, 0.02 * without_group) << edge;
    }
}

TYPED_TEST(EdgeInnovation, AnEdgeThatNothingPredictsHasNone) {
  RandomStream random(2, "bridge");
  auto graph = noisyGraph<TypeParam>(4, 0.01, 0.01, random);
  graph.edges.resize(3);  // A chain.
  const std::vector<bool> kept(3, true);
  EdgeInnovations innovations(graph.poses.size(), anchorsOf(graph), {{0}, {1}, {2}});
  for (const double squared : innovations.squared(whitenedEdges(graph, optimum(graph, kept).poses), kept).alone)
    EXPECT_NEAR(squared, 0.0, 1e-6);
}

}  // namespace
}  // namespace swiftlet::optimization
