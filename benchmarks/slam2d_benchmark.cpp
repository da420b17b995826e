// links: perception common
#include <benchmark/benchmark.h>

#include "perception/slam2d/slam2d.hpp"
#include "perception/slam2d/sliced_map.hpp"
#include "tests/slam2d/flight.hpp"

namespace {

using namespace swiftlet;

/// One loop through the flat at 1 m/s, 40 scans a second of 1,081 beams.
const std::vector<test::Flight::Step>& flownSteps() {
  static const std::vector<test::Flight::Step> steps = [] {
    test::Flight flight(test::flat(), test::SmoothPath(test::flatLoop(1), 1.0), {}, 1);
    std::vector<test::Flight::Step> all;
    while (!flight.done()) all.push_back(flight.next());
    return all;
  }();
  return steps;
}

/// Mean over the flight, key scans and drawing included, tasks not.
void addScan(benchmark::State& state) {
  const auto& steps = flownSteps();
  perception::Slam2d slam{perception::Slam2dConfig{}};
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(slam.addScan(steps[i].scan, steps[i].T_odom_body, steps[i].covariance_since_last));
    if (++i < steps.size()) continue;
    state.PauseTiming();
    slam = perception::Slam2d{perception::Slam2dConfig{}};
    i = 0;
    state.ResumeTiming();
  }
}
BENCHMARK(addScan)->Unit(benchmark::kMicrosecond)->Iterations(6000);

/// Mean over the flight: matching, covariance and the upkeep of the local map.
void laserOdometry(benchmark::State& state) {
  const auto& steps = flownSteps();
  perception::LaserOdometry odometry{perception::LaserOdometryConfig{}};
  std::size_t i = 0;
  std::optional<common::Pose2> last;
  for (auto _ : state) {
    benchmark::DoNotOptimize(odometry.add(steps[i].scan, last));
    last = steps[i].T_odom_body;
    if (++i < steps.size()) continue;
    state.PauseTiming();
    odometry = perception::LaserOdometry{perception::LaserOdometryConfig{}};
    last.reset();
    i = 0;
    state.ResumeTiming();
  }
}
BENCHMARK(laserOdometry)->Unit(benchmark::kMicrosecond)->Iterations(6000);

void drawScan(benchmark::State& state) {
  const perception::GridDrawingConfig config;
  perception::SlicedMap map(config);
  const auto& step = flownSteps()[400];
  for (auto _ : state) {
    const perception::DrawnScan drawn = perception::thinForDrawing(step.scan, config);
    map.draw(drawn, step.T_odom_body);
  }
}
BENCHMARK(drawScan)->Unit(benchmark::kMicrosecond);

}  // namespace
