// The choice among loop closures: false ones are refused, right ones kept, whatever the scale of the information; and
// it says so where it cannot tell. And the parts it is made of.
#include "optimization/closure_selection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "graphs.hpp"
#include "optimization/variance_factor.hpp"

namespace swiftlet::optimization {
namespace {

using common::RandomStream;
using test::noisyGraph;
using testing::Each;

template <typename Kind>
class ClosureSelectionOf : public testing::Test {};
using Kinds = testing::Types<test::Graph2D, test::Graph3D>;
TYPED_TEST_SUITE(ClosureSelectionOf, Kinds);

template <typename Graph>
std::vector<int> placesOf(const Graph& graph) {
  std::vector<int> places(graph.poses.size());
  std::iota(places.begin(), places.end(), 0);
  return places;
}

/// Connects random poses by random motions.
template <typename Kind>
void addFalse(typename Kind::Graph& graph, int count, RandomStream& random) {
  for (int i = 0; i < count; ++i) {
    auto edge = graph.edges.back();
    edge.from = static_cast<int>(random.uniform(0.0, 0.4) * static_cast<double>(graph.poses.size()));
    edge.to = static_cast<int>(random.uniform(0.6, 1.0) * static_cast<double>(graph.poses.size()));
    edge.T_from_to = Kind::randomPose(random, 3.0);
    graph.edges.push_back(edge);
  }
}

template <typename Kind>
typename Kind::Graph graphOf(int poses, RandomStream& random) {
  return noisyGraph<Kind>(poses, 0.01, 0.01, random);
}

/// Whether exactly the edges before the first false one are kept.
template <typename Graph>
void expectSplit(Graph graph, std::size_t first_false, const std::string& what) {
  const auto selection = selectClosures(*weighted(graph, placesOf(graph)));
  std::vector<bool> expected(graph.edges.size(), true);
  std::fill(expected.begin() + static_cast<std::ptrdiff_t>(first_false), expected.end(), false);
  EXPECT_EQ(selection.kept, expected) << what;
  EXPECT_EQ(selection.refused, graph.edges.size() - first_false) << what;
  EXPECT_TRUE(selection.sure) << what;
}

TYPED_TEST(ClosureSelectionOf, RefusesTheFalseOnesWhereTheInformationIsRightOrTooSmall) {
  for (const int count : {0, 1, 8})
    for (const double scale : {1e-4, 1.0}) {
      RandomStream random(7, "false");
      auto graph = graphOf<TypeParam>(60, random);
      const std::size_t first_false = graph.edges.size();
      addFalse<TypeParam>(graph, count, random);
      for (auto& edge : graph.edges) edge.information *= scale;
      expectSplit(graph, first_false, std::to_string(count) + " false, information times " + std::to_string(scale));
    }
}

TYPED_TEST(ClosureSelectionOf, IsNotSureWhereTheFalseOnesOutnumberTheRightOnes) {
  RandomStream random(8, "false");
  auto graph = graphOf<TypeParam>(40, random);
  addFalse<TypeParam>(graph, 30, random);
  EXPECT_FALSE(selectClosures(*weighted(graph, placesOf(graph))).sure);
}

TYPED_TEST(ClosureSelectionOf, OneOfTwoClosuresThatContradictEachOtherIsNotKnownToBeTheFalseOne) {
  RandomStream random(9, "two");
  auto graph = graphOf<TypeParam>(20, random);
  graph.edges.resize(graph.poses.size());  // The chain and one closure.
  graph.edges.push_back(graph.edges.back());
  graph.edges.back().T_from_to = TypeParam::randomPose(random, 3.0);
  const auto selection = selectClosures(*weighted(graph, placesOf(graph)));
  EXPECT_TRUE(selection.refused == 0 || !selection.sure);
}

TYPED_TEST(ClosureSelectionOf, IsNotSureWhereTheInformationOfAllIsFarTooGreat) {
  RandomStream random(7, "scale");
  auto graph = graphOf<TypeParam>(60, random);
  for (auto& edge : graph.edges) edge.information *= 1e6;
  const auto selection = selectClosures(*weighted(graph, placesOf(graph)));
  EXPECT_GT(selection.variance_factor, 20.0);
  EXPECT_FALSE(selection.sure);
}

TYPED_TEST(ClosureSelectionOf, ContradictsNoClosureOfACleanGraphAndFindsOneThatIsFalse) {
  RandomStream random(10, "doubt");
  auto graph = graphOf<TypeParam>(60, random);
  for (const double scale : {1e-4, 1e4, 1e4}) {  // Together 1e-4, 1 and 1e4.
    for (auto& edge : graph.edges) edge.information *= scale;
    graph.poses = optimize(graph, {}).poses;
    EXPECT_EQ(contradictedClosures(*weighted(graph, placesOf(graph))).refused, 0u);
  }
  addFalse<TypeParam>(graph, 1, random);
  graph.poses = optimize(graph, {}).poses;
  const auto selection = contradictedClosures(*weighted(graph, placesOf(graph)));
  EXPECT_EQ(selection.refused, 1u);
  EXPECT_FALSE(selection.kept.back());
}

TYPED_TEST(ClosureSelectionOf, AGraphWithoutClosuresIsKept) {
  RandomStream random(11, "chain");
  auto graph = graphOf<TypeParam>(10, random);
  graph.edges.resize(9);
  const auto selection = selectClosures(*weighted(graph, placesOf(graph)));
  EXPECT_THAT(selection.kept, Each(true));
  EXPECT_TRUE(selection.sure);
  EXPECT_EQ(selection.closures, 0u);
}

TEST(VarianceFactor, IsThatOfTheValuesAndTheGateIsBeyondThemButNotBeyondGrossErrors) {
  RandomStream random(12, "chi squared");
  for (const int size : {3, 6}) {
    std::vector<double> squared;
    for (int i = 0; i < 3000; ++i) {
      squared.push_back(0.0);
      for (int k = 0; k < size; ++k) squared.back() += std::pow(random.gaussian(0.2), 2);
    }
    EXPECT_NEAR(varianceFactor(squared, size), 0.04, 0.004);
    const double gate = gateOf(squared, size);
    EXPECT_GT(gate, *std::max_element(squared.begin(), squared.end()));
    for (int i = 0; i < 100; ++i) squared.push_back(1e6);
    EXPECT_LT(varianceFactor(squared, size), 0.06);
    EXPECT_LT(gateOf(squared, size), 3.0 * gate);
  }
  EXPECT_EQ(varianceFactor({}, 3), 1.0);
}

TEST(ClosureGroups, AreNeighboursAtBothEndsInEitherDirection) {
  const std::vector<std::pair<int, int>> ends{{100, 500}, {509, 108}, {117, 517}, {100, 530}, {140, 500}};
  const auto groups = closureGroups(ends, 10);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0], (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(closureGroups(ends, 2).size(), 4u) << "divided";
}

}  // namespace
}  // namespace swiftlet::optimization
