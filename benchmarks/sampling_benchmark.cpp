// links: sampling common
// First and simplified paths by sampling, beside OMPL's own RRT-Connect with the same check of places and its own of
// motions, and BIT* after 1 s. The room is 10 x 8 x 3 m in voxels of 5 cm, with two walls: a door in one, a window in
// the other.
#include <benchmark/benchmark.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <vector>

#include "planning/sampling/sampling_planner.hpp"

namespace {

using namespace swiftlet;
namespace ob = ompl::base;
namespace og = ompl::geometric;
using Eigen::Vector3d;
using planning::Clearance;

constexpr double kRadius_m = 0.375;
const Vector3d kStart(0.7, 0.7, 1.0), kGoal(9.3, 7.3, 1.0);

Clearance room() {
  common::VoxelMap map(0.05);
  for (int z = 0; z < 60; ++z)
    for (int y = 0; y < 160; ++y)
      for (int x = 0; x < 200; ++x) {
        const Vector3d at = map.centerOf({x, y, z});
        const bool door = at.y() > 5.0 && at.y() < 6.2 && at.z() < 2.1;
        const bool window = at.y() > 1.5 && at.y() < 2.7 && at.z() > 0.9 && at.z() < 2.1;
        const bool wall = (std::abs(at.x() - 3.3) < 0.1 && !door) || (std::abs(at.x() - 6.6) < 0.1 && !window);
        const bool pillar = std::abs(at.x() - 5.0) < 0.3 && std::abs(at.y() - 4.0) < 0.3;
        map.set({x, y, z}, wall || pillar ? std::int8_t{40} : std::int8_t{-40});
      }
  Clearance clearance = Clearance::ofSpace(0.05, 0.25);
  clearance.update(map.snapshot());
  return clearance;
}

double medianOf(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Of this thread: what others do on the machine does not count.
double processorTime_s() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Times and lengths of the calls, each with another seed.
template <typename Plan>
void run(benchmark::State& state, Plan&& plan) {
  std::vector<double> times_ms, lengths_m;
  for (auto _ : state) {
    const double begin_s = processorTime_s();
    lengths_m.push_back(plan());
    times_ms.push_back(1e3 * (processorTime_s() - begin_s));
  }
  state.counters["median_ms"] = medianOf(times_ms);
  state.counters["median_length_m"] = medianOf(lengths_m);
  state.counters["greatest_length_m"] = *std::max_element(lengths_m.begin(), lengths_m.end());
}

void bySampling(benchmark::State& state, bool simplify) {
  const Clearance clearance = room();
  planning::SamplingEffort effort;
  effort.simplify = simplify;
  std::uint64_t seed = 0;
  run(state, [&] { return planning::planBySampling(clearance, kStart, kGoal, kRadius_m, seed++, effort)->length_m; });
}
void FirstPath(benchmark::State& state) { bySampling(state, false); }
BENCHMARK(FirstPath)->Unit(benchmark::kMillisecond)->Iterations(500);
void SimplifiedPath(benchmark::State& state) { bySampling(state, true); }
BENCHMARK(SimplifiedPath)->Unit(benchmark::kMillisecond)->Iterations(500);

template <typename Planner>
double byOmpl(const Clearance& clearance, double most_s) {
  auto space = std::make_shared<ob::RealVectorStateSpace>(3);
  ob::RealVectorBounds bounds(3);
  const Vector3d low = clearance.min_map_m(), high = clearance.max_map_m();
  for (unsigned int axis = 0; axis < 3; ++axis) {
    bounds.low[axis] = low[axis];
    bounds.high[axis] = high[axis];
  }
  space->setBounds(bounds);
  auto info = std::make_shared<ob::SpaceInformation>(space);
  info->setStateValidityChecker([&](const ob::State* state) {
    const double* at = state->as<ob::RealVectorStateSpace::StateType>()->values;
    return clearance.at_m(Vector3d(at[0], at[1], at[2])) >= kRadius_m;
  });
  info->setup();
  auto problem = std::make_shared<ob::ProblemDefinition>(info);
  ob::ScopedState<ob::RealVectorStateSpace> start(info), goal(info);
  std::copy_n(kStart.data(), 3, start->values);
  std::copy_n(kGoal.data(), 3, goal->values);
  problem->setStartAndGoalStates(start, goal);
  Planner planner(info);
  planner.setProblemDefinition(problem);
  planner.setup();
  const double begin_s = processorTime_s();
  planner.solve(ob::PlannerTerminationCondition([&] { return processorTime_s() - begin_s > most_s; }));
  return problem->hasExactSolution() ? problem->getSolutionPath()->length() : 1e9;
}

void OmplFirstPath(benchmark::State& state) {
  ompl::msg::noOutputHandler();
  const Clearance clearance = room();
  run(state, [&] { return byOmpl<og::RRTConnect>(clearance, 1.0); });
}
BENCHMARK(OmplFirstPath)->Unit(benchmark::kMillisecond)->Iterations(500);

void OmplBitStarAfterOneSecond(benchmark::State& state) {
  ompl::msg::noOutputHandler();
  const Clearance clearance = room();
  run(state, [&] { return byOmpl<og::BITstar>(clearance, 1.0); });
}
BENCHMARK(OmplBitStarAfterOneSecond)->Unit(benchmark::kMillisecond)->Iterations(5);

}  // namespace
