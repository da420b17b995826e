// Starts of pose graphs: exact where there is no noise, whatever the guess; and the best of several is never worse than
// any of them.
#include "optimization/best_start.hpp"

#include <gtest/gtest.h>

#include "graphs.hpp"
#include "optimization/chordal_start.hpp"
#include "optimization/edge_error_3d.hpp"
#include "optimization/graph_parts.hpp"

namespace swiftlet::optimization {
namespace {

using common::RandomStream;
using test::noisyGraph;
using test::sum;

template <typename Kind>
class Starts : public testing::Test {};
using Kinds = testing::Types<test::Graph2D, test::Graph3D>;
TYPED_TEST_SUITE(Starts, Kinds);

/// A random guess, except for the first pose.
template <typename Kind>
typename Kind::Graph scrambled(typename Kind::Graph graph, RandomStream& random) {
  for (std::size_t i = 1; i < graph.poses.size(); ++i) graph.poses[i] = Kind::randomPose(random, 3.0);
  return graph;
}

template <typename Graph>
double chi2Of(const Graph& graph, const decltype(Graph::poses)& poses) {
  return sum(squaredErrors(graph, poses));
}

/// The distance of two poses as a squared error.
template <typename Graph>
double apart(const Graph&, const typename decltype(Graph::poses)::value_type& a,
             const typename decltype(Graph::poses)::value_type& b) {
  return edgeError(a, b, {}).error.squaredNorm();
}

TYPED_TEST(Starts, AreExactForAnyGuessWithoutNoise) {
  RandomStream random(1, "exact");
  const auto graph = scrambled<TypeParam>(noisyGraph<TypeParam>(30, 0.0, 0.0, random), random);
  EXPECT_GT(chi2Of(graph, graph.poses), 100.0);
  EXPECT_LT(chi2Of(graph, chordalStart(graph)), 1e-12);
  EXPECT_LT(chi2Of(graph, chainedPoses(graph)), 1e-12);
  const auto solution = optimizeFromBestStart(graph, {});
  EXPECT_LT(solution.chi2, 1e-12);
  EXPECT_TRUE(solution.converged);
}

/// A graph that is optimized again does not change, and is reported as optimized.
TYPED_TEST(Starts, AGraphAtItsOptimumIsReportedAsConverged) {
  for (const double sigma : {0.0, 0.05}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      RandomStream random(seed, "again");
      auto graph = noisyGraph<TypeParam>(10, sigma, sigma, random);
      for (int i = 0; i < 3; ++i) {
        const auto solution = optimizeFromBestStart(graph, {});
        EXPECT_TRUE(solution.converged) << sigma << " " << seed << " " << i;
        graph.poses = solution.poses;
      }
    }
  }
}

TYPED_TEST(Starts, NoStepIsTriedWhenAllPosesAreFixed) {
  RandomStream random(3, "fixed");
  auto graph = noisyGraph<TypeParam>(1, 0.0, 0.0, random);
  graph.edges.clear();
  EXPECT_EQ(optimizeFromBestStart(graph, {}).iterations, 0);
}

TYPED_TEST(Starts, DoNotDependOnTheGuess) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RandomStream random(seed, "guess");
    const auto graph = noisyGraph<TypeParam>(40, 0.05, 0.05, random);
    const auto near = optimizeFromBestStart(graph, {});
    const auto far = optimizeFromBestStart(scrambled<TypeParam>(graph, random), {});
    EXPECT_NEAR(far.chi2, near.chi2, 1e-6 * near.chi2) << seed;
    EXPECT_NEAR(near.chi2, chi2Of(graph, near.poses), 1e-9 * near.chi2) << "the reported chi2 is that of the poses";
    EXPECT_GT(far.chi2_guess, near.chi2_guess);
  }
}

TYPED_TEST(Starts, TheBestIsNeverWorseThanEachAlone) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    RandomStream random(seed, "noise");
    const auto graph = noisyGraph<TypeParam>(40, 0.5, 0.5, random);
    const auto best = optimizeFromBestStart(graph, {});
    auto from = graph;
    EXPECT_LE(best.chi2, best.chi2_guess);
    from.poses = chordalStart(graph);
    PoseGraphConfig alone;
    alone.max_iterations = BestStartConfig{}.max_iterations;
    alone.relative_decrease = BestStartConfig{}.relative_decrease;
    alone.trust_radius = 1e16;  // Steps of Gauss-Newton, as from each start.
    EXPECT_LE(best.chi2, sum(optimize(from, alone).squared_errors) * (1.0 + 1e-6)) << seed;
    EXPECT_GE(best.starts, 1);
  }
}

TYPED_TEST(Starts, UnconnectedPartsKeepTheirFirstPose) {
  RandomStream random(4, "parts");
  auto graph = noisyGraph<TypeParam>(10, 0.02, 0.3, random);
  const auto other = noisyGraph<TypeParam>(10, 0.02, 0.3, random);
  graph.poses.insert(graph.poses.end(), other.poses.begin(), other.poses.end());
  for (auto edge : other.edges) {
    edge.from += 10;
    edge.to += 10;
    graph.edges.push_back(edge);
  }
  EXPECT_EQ(anchorsOf(graph), (std::vector<int>{0, 10}));
  const auto solution = optimizeFromBestStart(graph, {});
  EXPECT_TRUE(solution.converged);
  for (const std::size_t i : {std::size_t{0}, std::size_t{10}})
    EXPECT_LT(apart(graph, graph.poses[i], solution.poses[i]), 1e-20) << i;
}

TYPED_TEST(Starts, FixedPosesStayInPlace) {
  RandomStream random(5, "fixed");
  auto graph = noisyGraph<TypeParam>(12, 0.02, 0.1, random);
  if constexpr (std::is_same_v<TypeParam, test::Graph2D>) {
    graph.fixed = 3;
    graph.also_fixed = {7};
  } else {
    graph.fixed = {3, 7};
  }
  const auto solution = optimizeFromBestStart(graph, {});
  for (const std::size_t i : {std::size_t{3}, std::size_t{7}})
    EXPECT_LT(apart(graph, graph.poses[i], solution.poses[i]), 1e-20) << i;
  EXPECT_LT(solution.chi2, solution.chi2_guess);
}

TYPED_TEST(Starts, TheSameGraphGivesIdenticalResults) {
  RandomStream random(6, "bits");
  const auto graph = noisyGraph<TypeParam>(60, 0.3, 0.5, random);
  const auto a = optimizeFromBestStart(graph, {}), b = optimizeFromBestStart(graph, {});
  EXPECT_EQ(a.chi2, b.chi2);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(squaredErrors(graph, a.poses), squaredErrors(graph, b.poses));
}

TYPED_TEST(Starts, AcceptGraphsWithNoneOrOnePose) {
  typename TypeParam::Graph graph;
  graph.poses.resize(1);
  EXPECT_EQ(optimizeFromBestStart(graph, {}).chi2, 0.0);
}

}  // namespace
}  // namespace swiftlet::optimization
