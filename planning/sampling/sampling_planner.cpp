// The headers of OMPL are read here alone: they take seconds to compile.
#include "planning/sampling/sampling_planner.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "common/random.hpp"
#include "planning/sampling/reachable_space.hpp"

namespace swiftlet::planning {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using common::RandomStream;
using Eigen::Vector3d;
using Space = ob::RealVectorStateSpace;
using Reason = SpacePlanFailure::Reason;

/// Trees that are grown for a path that is to be short: each may lead another way around.
constexpr int kTrees = 3;
/// Shortcuts that are tried, and in a row without one that is free.
constexpr unsigned int kShortcuts = 400, kVainShortcuts = 100;

/// The messages of OMPL go to the terminal of the whole process.
void silence() {
  static const bool kSilent = [] {
    ompl::msg::noOutputHandler();
    return true;
  }();
  (void)kSilent;
}

/// What is planned in: places between the clearance and the states of OMPL.
struct Room {
  const Clearance& clearance;
  double radius_m;
  double height_m;  ///< Of a plane.
  int dimensions() const { return clearance.isPlane() ? 2 : 3; }

  Vector3d placeOf(const ob::State* state) const {
    const double* values = state->as<Space::StateType>()->values;
    return {values[0], values[1], clearance.isPlane() ? height_m : values[2]};
  }
  void setPlace(ob::State* state, const Vector3d& place_map_m) const {
    std::copy_n(place_map_m.data(), dimensions(), state->as<Space::StateType>()->values);
  }
};

/// Each sampler draws from a stream of its own: those of OMPL are seeded from one generator of the whole process, in
/// the order in which threads happen to make them.
class StreamSampler final : public ob::StateSampler {
 public:
  StreamSampler(const ob::StateSpace* space, RandomStream stream) : StateSampler(space), stream_(stream) {}

  void sampleUniform(ob::State* state) override {
    each(state, [&](unsigned int, double low, double high) { return stream_.uniform(low, high); });
  }
  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
    const double* middle = near->as<Space::StateType>()->values;
    each(state, [&](unsigned int axis, double low, double high) {
      return stream_.uniform(std::max(low, middle[axis] - distance), std::min(high, middle[axis] + distance));
    });
  }
  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation) override {
    const double* middle = mean->as<Space::StateType>()->values;
    each(state, [&](unsigned int axis, double low, double high) {
      return std::clamp(middle[axis] + stream_.gaussian(deviation), low, high);
    });
  }

 private:
  template <typename Draw>
  void each(ob::State* state, Draw&& draw) {
    const ob::RealVectorBounds& bounds = space_->as<Space>()->getBounds();
    for (unsigned int axis = 0; axis < space_->getDimension(); ++axis)
      state->as<Space::StateType>()->values[axis] = draw(axis, bounds.low[axis], bounds.high[axis]);
  }

  RandomStream stream_;
};

class HullMotion final : public ob::MotionValidator {
 public:
  HullMotion(const ob::SpaceInformationPtr& info, const Room& room) : MotionValidator(info), room_(room) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    return room_.clearance.isFree(room_.placeOf(from), room_.placeOf(to), room_.radius_m);
  }
  bool checkMotion(const ob::State* from, const ob::State* to, std::pair<ob::State*, double>& last) const override {
    if (checkMotion(from, to)) return true;
    if (last.first != nullptr) si_->copyState(last.first, from);
    last.second = 0.0;
    return false;
  }

 private:
  const Room& room_;
};

class SeededTrees final : public og::RRTConnect {
 public:
  SeededTrees(const ob::SpaceInformationPtr& info, std::uint32_t seed) : RRTConnect(info) { rng_.setLocalSeed(seed); }
  std::size_t states() const { return tStart_->size() + tGoal_->size(); }
};

class SeededSimplifier final : public og::PathSimplifier {
 public:
  SeededSimplifier(const ob::SpaceInformationPtr& info, std::uint32_t seed) : PathSimplifier(info) {
    rng_.setLocalSeed(seed);
  }
};

class Sampling {
 public:
  Sampling(const Room& room, std::uint64_t seed) : room_(room), seeds_(seed, "sampling planner") {
    silence();
    const auto space = std::make_shared<Space>(static_cast<unsigned int>(room.dimensions()));
    ob::RealVectorBounds bounds(static_cast<unsigned int>(room.dimensions()));
    const Vector3d low = room.clearance.min_map_m(), high = room.clearance.max_map_m();
    bounds.low.assign(low.data(), low.data() + room.dimensions());
    bounds.high.assign(high.data(), high.data() + room.dimensions());
    space->setBounds(bounds);
    space->setStateSamplerAllocator([this](const ob::StateSpace* of) {
      return std::make_shared<StreamSampler>(of, RandomStream(seeds_.bits(), "samples"));
    });
    info_ = std::make_shared<ob::SpaceInformation>(space);
    info_->setStateValidityChecker(
        [this](const ob::State* state) { return room_.clearance.at_m(room_.placeOf(state)) >= room_.radius_m; });
    info_->setMotionValidator(std::make_shared<HullMotion>(info_, room_));
    info_->setup();
  }

  /// A first path; nullopt if the trees do not meet within the iterations.
  std::optional<og::PathGeometric> grow(const Vector3d& start_map_m, const Vector3d& goal_map_m, int iterations) {
    const auto problem = std::make_shared<ob::ProblemDefinition>(info_);
    ob::ScopedState<Space> start(info_), goal(info_);
    room_.setPlace(start.get(), start_map_m);
    room_.setPlace(goal.get(), goal_map_m);
    problem->setStartAndGoalStates(start, goal);
    SeededTrees trees(info_, seed32());
    trees.setProblemDefinition(problem);
    ob::IterationTerminationCondition most(static_cast<unsigned int>(iterations));
    const bool solved = trees.solve(most) == ob::PlannerStatus::EXACT_SOLUTION;
    states_ += trees.states();
    if (!solved) return std::nullopt;
    return *problem->getSolutionPath()->as<og::PathGeometric>();
  }

  /// Leaves out points of a path, without moving any.
  void reduce(og::PathGeometric& path) { SeededSimplifier(info_, seed32()).reduceVertices(path); }

  void shorten(og::PathGeometric& path) {
    SeededSimplifier simplifier(info_, seed32());
    simplifier.shortcutPath(path, kShortcuts, kVainShortcuts);
    simplifier.reduceVertices(path);
  }

  og::PathGeometric through(const std::vector<Vector3d>& places_map_m) const {
    og::PathGeometric path(info_);
    for (const Vector3d& place_m : places_map_m) {
      ob::ScopedState<Space> state(info_);
      room_.setPlace(state.get(), place_m);
      path.append(state.get());
    }
    return path;
  }

  SpacePath pathOf(const og::PathGeometric& from) const {
    SpacePath path;
    for (std::size_t i = 0; i < from.getStateCount(); ++i)
      path.points_map_m.push_back(room_.placeOf(from.getState(static_cast<unsigned int>(i))));
    path.clearance_m = room_.clearance.reach_m();
    for (std::size_t i = 1; i < path.points_map_m.size(); ++i) {
      path.length_m += (path.points_map_m[i] - path.points_map_m[i - 1]).norm();
      path.clearance_m =
          std::min(path.clearance_m, room_.clearance.along_m(path.points_map_m[i - 1], path.points_map_m[i]));
    }
    path.states = states_;
    return path;
  }

 private:
  std::uint32_t seed32() { return static_cast<std::uint32_t>(seeds_.bits()); }

  const Room& room_;
  RandomStream seeds_;
  ob::SpaceInformationPtr info_;
  std::size_t states_ = 0;
};

std::string textOf(const Vector3d& place_m) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", place_m.x(), place_m.y(), place_m.z());
}

/// nullopt if the hull may be there.
std::optional<SpacePlanFailure> refusalOf(const Room& room, const Vector3d& place_map_m, bool is_start) {
  constexpr double kNear_m = 3.0;
  const char* what = is_start ? "start" : "goal";
  if (!place_map_m.allFinite())
    return SpacePlanFailure{Reason::kOutsideMap, fmt::format("the {} is not a point", what), {}};
  const Vector3d low = room.clearance.min_map_m(), high = room.clearance.max_map_m();
  const auto inside = [&](int axis) { return place_map_m[axis] >= low[axis] && place_map_m[axis] < high[axis]; };
  if (!inside(0) || !inside(1) || (!room.clearance.isPlane() && !inside(2)))
    return SpacePlanFailure{
        Reason::kOutsideMap, fmt::format("{} {} is outside the map", what, textOf(place_map_m)), {}};
  const double here_m = room.clearance.at_m(place_map_m);
  if (here_m >= room.radius_m) return std::nullopt;
  return SpacePlanFailure{
      is_start ? Reason::kStartBlocked : Reason::kGoalBlocked,
      here_m == 0.0 ? fmt::format("{} {} is not known to be free", what, textOf(place_map_m))
                    : fmt::format("{} {} is {:.2f} m from what is in the way, less than the {:.2f} m of the hull", what,
                                  textOf(place_map_m), here_m, room.radius_m),
      nearestFreePlace(room.clearance, place_map_m, room.radius_m, kNear_m)};
}

}  // namespace

tl::expected<SpacePath, SpacePlanFailure> planBySampling(const Clearance& clearance, const Vector3d& start_map_m,
                                                         const Vector3d& goal_map_m, double radius_m,
                                                         std::uint64_t seed, const SamplingEffort& effort) {
  const Room room{clearance, radius_m, start_map_m.z()};
  for (const bool is_start : {true, false})
    if (auto refusal = refusalOf(room, is_start ? start_map_m : goal_map_m, is_start))
      return tl::make_unexpected(*std::move(refusal));
  Sampling sampling(room, seed);
  std::optional<og::PathGeometric> best;
  for (int tree = 0; tree < (effort.simplify ? kTrees : 1); ++tree) {
    auto path = sampling.grow(start_map_m, goal_map_m, effort.iterations);
    if (!path) break;
    if (effort.simplify) sampling.reduce(*path);
    if (!best || path->length() < best->length()) best = std::move(path);
  }
  if (best) {
    if (effort.simplify) sampling.shorten(*best);
    return sampling.pathOf(*best);
  }

  const ReachableSpace reachable(clearance, start_map_m, radius_m, goal_map_m);
  if (!reachable.reaches(goal_map_m))
    return tl::make_unexpected(
        SpacePlanFailure{Reason::kUnreachable,
                         fmt::format("goal {} is unreachable for a hull of {:.2f} m", textOf(goal_map_m), radius_m),
                         reachable.nearestTo(goal_map_m)});
  std::vector<Vector3d> cells = reachable.pathTo(goal_map_m);
  cells.front() = start_map_m;
  cells.back() = goal_map_m;
  if (cells.size() == 1) cells.insert(cells.begin(), start_map_m);
  og::PathGeometric path = sampling.through(cells);
  sampling.reduce(path);
  sampling.shorten(path);
  return sampling.pathOf(path);
}

}  // namespace swiftlet::planning
