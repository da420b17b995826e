// links: perception common
// The estimator's share of a tick: strapdown step, a late scan, deskew poses, altitude with ten beams.
#include <benchmark/benchmark.h>

#include "common/random.hpp"
#include "perception/altitude/multilevel_filter.hpp"
#include "perception/fusion/error_state_filter.hpp"

namespace swiftlet::perception {
namespace {

using common::Duration;
using common::Time;

/// A hovering vehicle, 200 Hz.
struct Hover {
  ErrorStateFilter filter{ErrorStateFilter::Config{}};
  common::ImuSample sample;
  common::RandomStream random{1, "benchmark"};
  Time reference;

  Hover() {
    sample.specific_force_body_m_s2 = {0, 0, 9.81};
    for (int i = 0; i < 200; ++i) step();
    if (!filter.initialize(0.15)) std::abort();
    for (int i = 0; i < 300; ++i) step();
    reference = filter.newest();
    (void)filter.add(perception::poseClone(reference));
    for (int i = 0; i < 10; ++i) step();
  }
  void step() {
    sample.stamps.measured += Duration::fromMilliseconds(5);
    sample.angular_velocity_body_rad_s.x() = random.gaussian(0.01);
    filter.predict(sample);
  }
  void scan(Duration late) {
    const Time at = filter.newest() - late;
    (void)filter.add(perception::measuredHeight(at, 0.15 + random.gaussian(0.01), 1e-4));
    (void)filter.add(perception::measuredRelativePose(
        reference, at, {random.gaussian(0.01), random.gaussian(0.01), 0.0}, 1e-4 * Eigen::Matrix3d::Identity()));
  }
};

void BM_Predict(benchmark::State& state) {
  Hover hover;
  for (auto _ : state) hover.step();
}
BENCHMARK(BM_Predict);

/// One relative pose and one height so many milliseconds late, and the state after them. One IMU sample later each, to
/// keep the clock going; its cost is BM_Predict.
void BM_LateScan(benchmark::State& state) {
  Hover hover;
  const auto late = Duration::fromNanoseconds(state.range(0) * 1'000'000 + 1'300'000);
  for (auto _ : state) {
    hover.scan(late);
    benchmark::DoNotOptimize(hover.filter.state());
    state.PauseTiming();
    for (int i = 0; i < 5; ++i) hover.step();
    state.ResumeTiming();
  }
}
BENCHMARK(BM_LateScan)->Arg(0)->Arg(20)->Arg(100)->Arg(300)->Unit(benchmark::kMicrosecond);

void BM_DeskewPoses(benchmark::State& state) {
  Hover hover;
  const Time from = hover.filter.newest() - Duration::fromMilliseconds(35);
  for (auto _ : state) {
    const PoseHistory poses = hover.filter.motion(from, from + Duration::fromMilliseconds(20));
    for (int beam = 0; beam < 1081; ++beam)
      benchmark::DoNotOptimize(poses.at(from + Duration::fromNanoseconds(beam * 17'300)));
  }
}
BENCHMARK(BM_DeskewPoses)->Unit(benchmark::kMicrosecond);

void BM_Altitude(benchmark::State& state) {
  MultilevelFilter filter({});
  common::RandomStream random(1, "altitude");
  Time now;
  filter.initialize(now, {0, 0}, 1.5);
  std::vector<GroundPoint> points(10);
  double t = 0;
  for (auto _ : state) {
    t += 0.025;
    const Eigen::Vector2d at(5.0 * std::sin(0.1 * t), 5.0 * std::sin(0.13 * t));
    const bool table = std::sin(3 * at.x()) > 0.6;
    now += Duration::fromMilliseconds(25);
    for (std::size_t i = 0; i < points.size(); ++i)
      points[i] = {at + Eigen::Vector2d(0, 0.004 * static_cast<double>(i)),
                   1.5 - (table ? 0.77 : 0.0) + random.gaussian(0.01)};
    benchmark::DoNotOptimize(filter.update({.stamp = now,
                                            .position_map_m = at,
                                            .points = points,
                                            .known = {1.5, 0.0, 0.0, 1e-4 * Eigen::Matrix3d::Identity()},
                                            .climb = InertialClimb{0.0, 0.0, 0.02}}));
  }
  state.counters["levels"] = static_cast<double>(filter.levels().levels.size());
}
BENCHMARK(BM_Altitude)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace swiftlet::perception
