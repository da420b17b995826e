// links: perception common
#include <benchmark/benchmark.h>

#include "perception/localization/global_search.hpp"
#include "perception/localization/local_map.hpp"
#include "perception/localization/particle_filter.hpp"
#include "perception/localization/place_posterior.hpp"
#include "tests/localization/buildings.hpp"

namespace {

using namespace swiftlet;
using common::Pose2;

struct Scene {
  test::Building building = test::offices(1);
  std::shared_ptr<const perception::MapField> field =
      std::make_shared<const perception::MapField>(test::mapOf(building));
  std::vector<std::vector<Eigen::Vector2f>> scans;

  Scene() {
    for (std::uint64_t i = 0; i < 32; ++i) {
      common::RandomStream random(7, "benchmark", i);
      scans.push_back(test::levelScan(building.world, poseAt(i), common::Time{}, random).points_level_m);
    }
  }
  static Pose2 poseAt(std::uint64_t i) {
    return {3.0 + 0.2 * static_cast<double>(i), 0.0, 0.02 * static_cast<double>(i)};
  }
};
const Scene& scene() {
  static const Scene scene;
  return scene;
}

const Eigen::Matrix3d kStep = Eigen::Vector3d(4e-4, 4e-4, 1e-4).asDiagonal();

/// Whole updates along the walk, begun anew by `spread` after its last scan: noise, weights, resampling, mean.
template <typename Spread>
void updateAlongTheWalk(benchmark::State& state, perception::ParticleFilter& filter, const Spread& spread) {
  const auto& scans = scene().scans;
  std::uint64_t i = 0;
  for (auto _ : state) {
    if (i % scans.size() == 0) {
      state.PauseTiming();
      spread();
      state.ResumeTiming();
    }
    filter.move(between(Scene::poseAt(0), Scene::poseAt(1)), kStep);
    filter.weigh(scans[i % scans.size()]);
    filter.resample();
    benchmark::DoNotOptimize(filter.estimate());
    ++i;
  }
}

void spreadAtTheBegin(perception::ParticleFilter& filter) {
  const perception::PoseHypothesis here{Scene::poseAt(0), Eigen::Vector3d(0.01, 0.01, 0.003).asDiagonal(), 1.0};
  filter.spreadAround(std::span(&here, 1));
}

/// 5,000 particles x 60 beams; KLD off. The argument chooses the instructions.
void update(benchmark::State& state, bool global) {
  const auto instructions = static_cast<perception::Instructions>(state.range(0));
  if (!perception::isAvailable(instructions)) {
    state.SkipWithError("this machine has no such instructions");
    return;
  }
  state.SetLabel(toString(instructions));
  perception::ParticleFilterConfig config;
  config.adaptive = false;
  // Spread over the whole building the particles would gather within a few updates: they are told nothing.
  if (global) config.beam_weight = 1e-6;
  perception::ParticleFilter filter(scene().field, config, 1, instructions);
  updateAlongTheWalk(state, filter, [&] { global ? filter.spreadOverFreeSpace() : spreadAtTheBegin(filter); });
}
BENCHMARK_CAPTURE(update, tracking, false)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(update, global, true)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);

/// As many particles as the belief needs.
void updateAdaptively(benchmark::State& state) {
  perception::ParticleFilter filter(scene().field, perception::ParticleFilterConfig{}, 1);
  updateAlongTheWalk(state, filter, [&] { spreadAtTheBegin(filter); });
}
BENCHMARK(updateAdaptively)->Unit(benchmark::kMicrosecond);

/// The whole building, every place where a local map of three metres fits, each at its best.
void searchGlobally(benchmark::State& state) {
  perception::LocalMap local_map(12.0);
  for (std::uint64_t i = 0; i < 15; ++i) local_map.add(Scene::poseAt(i), scene().scans[i]);
  const auto whole = local_map.whole(0.15, 160);
  perception::GlobalSearch search(scene().field, perception::GlobalSearchConfig{});
  for (auto _ : state) {
    const auto found = search.search(whole.points_middle_m, 0.2);
    benchmark::DoNotOptimize(perception::likelyPlaces(perception::bestInstructions(), *scene().field, found.places,
                                                      whole.points_middle_m, 0.15, 0.2, {0.5, 0.26}));
  }
}
BENCHMARK(searchGlobally)->Unit(benchmark::kMillisecond);

void readMap(benchmark::State& state) {
  const common::OccupancyGrid map = test::mapOf(scene().building);
  for (auto _ : state) benchmark::DoNotOptimize(perception::MapField(map));
}
BENCHMARK(readMap)->Unit(benchmark::kMillisecond);

}  // namespace
