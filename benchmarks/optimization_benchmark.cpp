// links: optimization common
// Pose graphs as flights make them: rows of a field flown to and fro, 1 m a pose, neighbours of the rows beside it seen
// again. One core; the argument is the number of poses.
#include <benchmark/benchmark.h>

#include "common/random.hpp"
#include "optimization/best_start.hpp"
#include "optimization/chordal_start.hpp"
#include "optimization/graph_parts.hpp"

namespace {

using namespace swiftlet;
using optimization::PoseGraph2D;
using optimization::PoseGraph3D;

constexpr int kRow = 50;

common::Pose3 placeOf(int index) {
  const int row = index / kRow, along = index % kRow;
  const bool back = row % 2 == 1;
  return {common::quaternionFrom({0.0, 0.0, back ? 3.1 : 0.0}),
          {static_cast<double>(back ? kRow - 1 - along : along), static_cast<double>(row), 0.0}};
}

common::Pose3 noise(common::RandomStream& random, double size) {
  return {common::expSO3({random.gaussian(size), random.gaussian(size), random.gaussian(size)}),
          {random.gaussian(size), random.gaussian(size), random.gaussian(size)}};
}

PoseGraph3D fieldInSpace(int poses) {
  common::RandomStream random(1, "field");
  PoseGraph3D graph;
  const auto see = [&](int from, int to) {
    optimization::PoseEdge3D edge;
    edge.from = from;
    edge.to = to;
    edge.T_from_to = placeOf(from).inverse() * placeOf(to) * noise(random, 0.03);
    edge.information = 1e3 * optimization::Matrix6d::Identity();
    graph.edges.push_back(edge);
  };
  for (int i = 0; i + 1 < poses; ++i) see(i, i + 1);
  for (int i = 0; i + 2 * kRow < poses; i += 3) see(i, (i / kRow + 2) * kRow - 1 - i % kRow);
  graph.poses.resize(static_cast<std::size_t>(poses), placeOf(0));
  graph.poses = chainedPoses(graph);
  return graph;
}

PoseGraph2D fieldInThePlane(int poses) {
  const PoseGraph3D space = fieldInSpace(poses);
  PoseGraph2D graph;
  for (const auto& pose : space.poses) graph.poses.push_back(common::planar(pose));
  for (const auto& edge : space.edges)
    graph.edges.push_back(
        {edge.from, edge.to, common::planar(edge.T_from_to), 1e3 * Eigen::Matrix3d::Identity(), false});
  return graph;
}

void optimizeInThePlane(benchmark::State& state) {
  const PoseGraph2D graph = fieldInThePlane(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(optimizeFromBestStart(graph, {}));
}
BENCHMARK(optimizeInThePlane)->Arg(1000)->Arg(10'000)->Unit(benchmark::kMillisecond);

void optimizeInSpace(benchmark::State& state) {
  const PoseGraph3D graph = fieldInSpace(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(optimizeFromBestStart(graph, {}));
}
BENCHMARK(optimizeInSpace)->Arg(1000)->Arg(5000)->Unit(benchmark::kMillisecond);

void startInSpace(benchmark::State& state) {
  const PoseGraph3D graph = fieldInSpace(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(chordalStart(graph));
}
BENCHMARK(startInSpace)->Arg(5000)->Unit(benchmark::kMillisecond);

}  // namespace
